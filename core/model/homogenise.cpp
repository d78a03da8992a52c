// The elongation of a spring with rest vector R under the uniform strain e and the displacements u
// of the particles relative to it is (R.e.R + R.(u_b - u_a)) / |R|; that of a cross spring is
// (R.e.R + R.(u_b - u_a) + Delta (h_a + h_b)) / sqrt(R^2 + Delta^2), with the heights h. The energy
//   V e.C.e / 2 = e.A.e / 2 - f(e).u + u.K.u / 2
// has its minimum where K u = f(e). Conjugate gradients solve this for six strains; then
//   C = (A - f.u) / V.
// The volumetric energy of a particle is K_v / (2 V_i) (V_i tr e + sum g.u)^2, with the gradients g
// of its volume V_i by the places of the particles around it.
#include <model/homogenise.hpp>
#include <model/nodal_volumes.hpp>

#include <Eigen/Dense>

#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr int strains = 6;  // xx, yy, zz, 2 yz, 2 xz, 2 xy
using Strains = Eigen::Matrix<double, strains, 1>;
using Stiffness = Eigen::Matrix<double, strains, strains>;
/// One row for each degree of freedom, one column for each strain.
using Field = Eigen::Matrix<double, Eigen::Dynamic, strains, Eigen::RowMajor>;

/// The elongation of one spring as a linear function of the strain and of the displacements.
struct Growth {
  std::uint32_t a = 0, b = 0;
  double stiffness = 0;
  Strains by_strain;
  /// Derivatives by b's displacement x, y, z and height. Those by a's displacement have the
  /// opposite sign, the one by a's height is the same.
  double by_b[4] = {};
};

/// The growth of the volume of one particle: volume (e_xx + e_yy + e_zz) + sum g.u.
struct VolumeGrowth {
  double modulus = 0, volume = 0;  ///< K_v, Pa; m3
  std::vector<VolumeDerivative> derivatives;
};

class Sample {
 public:
  Sample(std::uint32_t particles, bool free) : particles_(particles), components_(free ? 4 : 3) {}

  void add(const Growth& growth) {
    springs_.push_back(growth);
    affine_ += growth.stiffness * growth.by_strain * growth.by_strain.transpose();
    common_load_ += growth.stiffness * 2 * growth.by_b[3] * growth.by_strain;
    common_stiffness_ += growth.stiffness * 4 * growth.by_b[3] * growth.by_b[3];
  }
  void add(VolumeGrowth growth) {
    const Strains by_strain = trace();
    affine_ += growth.modulus * growth.volume * by_strain * by_strain.transpose();
    volumes_.push_back(std::move(growth));
  }
  void set_alpha(double alpha) {
    alpha_ = alpha;
    common_stiffness_ += 2 * alpha * particles_;
  }

  /// Returns the elastic constants times the volume, J, for equal strain of all particles and one
  /// height of all.
  Stiffness strained_alike() const {
    if (common_stiffness_ == 0) return affine_;
    return affine_ - common_load_ * common_load_.transpose() / common_stiffness_;
  }

  /// Returns the elastic constants times the volume, J, with each particle at rest. Conjugate
  /// gradients solve for all strains at once.
  Stiffness relaxed() const {
    // Relative to the load. The relative error of the energy is about the square of it.
    constexpr double tolerance = 1e-8;
    constexpr int most = 20000;
    const Field load = this->load();
    const Eigen::VectorXd inverse = diagonal().cwiseInverse();
    Field moved = Field::Zero(load.rows(), strains), rest = load,
          direction = inverse.asDiagonal() * rest;
    Strains product = columns(rest, direction);
    const Strains enough = tolerance * tolerance * load.colwise().squaredNorm().transpose();
    for (int n = 0; (rest.colwise().squaredNorm().transpose().array() > enough.array()).any();
         ++n) {
      if (n == most)
        throw std::invalid_argument(
            "the lattice's springs make no solid: its sample finds no rest under a strain");
      const Field resisted = resistance(direction);
      const Strains length = ratio(product, columns(direction, resisted));
      moved += direction * length.asDiagonal();
      rest -= resisted * length.asDiagonal();
      const Field better = inverse.asDiagonal() * rest;
      const Strains next = columns(rest, better);
      direction = better + direction * ratio(next, product).asDiagonal();
      product = next;
    }
    const Stiffness found = affine_ - load.transpose() * moved;
    return 0.5 * (found + found.transpose());
  }

 private:
  /// Returns the scalar products of corresponding columns.
  static Strains columns(const Field& a, const Field& b) {
    return a.cwiseProduct(b).colwise().sum().transpose();
  }
  /// Returns a / b, and 0 for columns with b = 0, which have converged.
  static Strains ratio(const Strains& a, const Strains& b) {
    return (b.array() != 0).select(a.array() / b.array(), 0.0).matrix();
  }

  Eigen::Index at(std::uint32_t particle) const {
    return static_cast<Eigen::Index>(particle) * components_;
  }
  /// Adds the generalised forces of a spring to the rows of both ends; `pull`: one force for each
  /// strain.
  template <class Pull>
  void spread(Field& field, const Growth& growth, const Pull& pull) const {
    for (int c = 0; c < components_; ++c) {
      const double by_b = growth.by_b[c], by_a = c == 3 ? by_b : -by_b;
      field.row(at(growth.b) + c) += by_b * pull;
      field.row(at(growth.a) + c) += by_a * pull;
    }
  }
  static Strains trace() {
    Strains trace = Strains::Zero();
    trace.head<3>().setOnes();
    return trace;
  }
  static Eigen::RowVector3d row_of(Vec3 v) { return {v.x, v.y, v.z}; }
  /// Adds the forces of a pressure for each strain on the particles of a volume.
  void press(Field& field, const VolumeGrowth& growth,
             const Eigen::Matrix<double, 1, strains>& pressure) const {
    for (const VolumeDerivative& of : growth.derivatives)
      field.middleRows<3>(at(of.particle)) += row_of(of.gradient).transpose() * pressure;
  }
  Field load() const {
    Field load = Field::Zero(at(particles_), strains);
    for (const VolumeGrowth& growth : volumes_)
      press(load, growth, -growth.modulus * trace().transpose());
    for (const Growth& growth : springs_)
      spread(load, growth, -growth.stiffness * growth.by_strain.transpose());
    return load;
  }
  Field resistance(const Field& moved) const {
    Field forces = Field::Zero(moved.rows(), strains);
    for (const Growth& growth : springs_) {
      Eigen::Matrix<double, 1, strains> grown = Eigen::Matrix<double, 1, strains>::Zero();
      for (int c = 0; c < components_; ++c)
        grown += growth.by_b[c] *
                 (c == 3 ? moved.row(at(growth.b) + c) + moved.row(at(growth.a) + c)
                         : Eigen::Matrix<double, 1, strains>(moved.row(at(growth.b) + c) -
                                                             moved.row(at(growth.a) + c)));
      spread(forces, growth, growth.stiffness * grown);
    }
    for (const VolumeGrowth& growth : volumes_) {
      Eigen::Matrix<double, 1, strains> grown = Eigen::Matrix<double, 1, strains>::Zero();
      for (const VolumeDerivative& of : growth.derivatives)
        grown += row_of(of.gradient) * moved.middleRows<3>(at(of.particle));
      press(forces, growth, growth.modulus / growth.volume * grown);
    }
    for (std::uint32_t p = 0; components_ == 4 && p < particles_; ++p)
      forces.row(at(p) + 3) += 2 * alpha_ * moved.row(at(p) + 3);
    return forces;
  }
  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(at(particles_));
    for (const Growth& growth : springs_)
      for (int c = 0; c < components_; ++c)
        for (const std::uint32_t end : {growth.a, growth.b})
          sum(at(end) + c) += growth.stiffness * growth.by_b[c] * growth.by_b[c];
    for (const VolumeGrowth& growth : volumes_)
      for (const VolumeDerivative& of : growth.derivatives)
        for (int c = 0; c < 3; ++c)
          sum(at(of.particle) + c) +=
              growth.modulus / growth.volume * of.gradient[c] * of.gradient[c];
    for (std::uint32_t p = 0; components_ == 4 && p < particles_; ++p) sum(at(p) + 3) += 2 * alpha_;
    for (double& value : sum)
      if (value == 0) value = 1;  // a degree of freedom that no spring holds
    return sum;
  }

  std::uint32_t particles_;
  int components_;
  std::vector<Growth> springs_;
  std::vector<VolumeGrowth> volumes_;
  double alpha_ = 0;
  Stiffness affine_ = Stiffness::Zero();
  Strains common_load_ = Strains::Zero();
  double common_stiffness_ = 0;
};

Growth growth_of(std::uint32_t a, std::uint32_t b, Vec3 rest, double length, double height,
                 double stiffness) {
  const double n = 1 / length;
  Growth growth{a, b, stiffness, {}, {n * rest.x, n * rest.y, n * rest.z, n * height}};
  growth.by_strain << n * rest.x * rest.x, n * rest.y * rest.y, n * rest.z * rest.z,
      n * rest.y * rest.z, n * rest.x * rest.z, n * rest.x * rest.y;
  return growth;
}

/// Returns the isotropic constants by Voigt's means.
ElasticConstants isotropic(const Stiffness& c) {
  const double C11 = (c(0, 0) + c(1, 1) + c(2, 2)) / 3, C12 = (c(0, 1) + c(0, 2) + c(1, 2)) / 3,
               C44 = (c(3, 3) + c(4, 4) + c(5, 5)) / 3;
  const double bulk = (C11 + 2 * C12) / 3, shear = (C11 - C12 + 3 * C44) / 5;
  return {bulk + 4 * shear / 3, bulk - 2 * shear / 3, shear};
}

/// Adds the volumetric energies. The particles of a body without a sample are strained alike, so
/// that only the sum of their volumes counts.
void add_volumes(const Listed& listed, double modulus, double volume, Sample& sample) {
  if (modulus == 0) return;
  if (listed.sample_particles == 0) return sample.add(VolumeGrowth{modulus, volume, {}});
  SampleVolumes volumes = volumes_of_sample(listed);
  for (std::size_t p = 0; p < volumes.volumes.size(); ++p)
    sample.add(VolumeGrowth{modulus, volumes.volumes[p], std::move(volumes.derivatives[p])});
}

Sample sample_of(const Listed& listed, double volume, double membrane_distance,
                 const MaterialConstants& constants) {
  const bool cross = constants.has_cross_springs(), free = cross && !constants.clamped;
  Sample sample(listed.sample_particles > 0 ? listed.sample_particles
                                            : static_cast<std::uint32_t>(listed.positions.size()),
                free);
  const auto add = [&](std::uint32_t a, std::uint32_t b, Vec3 rest, double factor) {
    const double k = factor * constants.base_stiffness, length = norm(rest);
    sample.add(growth_of(a, b, rest, length, 0, k));
    if (cross)
      sample.add(growth_of(a, b, rest, std::hypot(length, membrane_distance),
                           free ? membrane_distance : 0, constants.cross_ratio[0] * k));
  };
  for (const SampleSpring& spring : listed.sample)
    add(spring.a, spring.b, spring.rest, spring.stiffness);
  if (listed.sample_particles == 0)
    for (const ListedSpring& spring : listed.springs)
      add(spring.a, spring.b, listed.positions[spring.b] - listed.positions[spring.a],
          spring.stiffness);
  add_volumes(listed, constants.volumetric, volume, sample);
  if (free) sample.set_alpha(constants.alpha_ratio * constants.base_stiffness);
  return sample;
}

}  // namespace

ElasticConstants homogenise(const Listed& listed, double volume, double membrane_distance,
                            const MaterialConstants& constants) {
  if (listed.sample_particles == 0)
    return strained_alike(listed, volume, membrane_distance, constants);
  return isotropic(sample_of(listed, volume, membrane_distance, constants).relaxed() /
                   listed.sample_volume);
}

ElasticConstants strained_alike(const Listed& listed, double volume, double membrane_distance,
                                const MaterialConstants& constants) {
  return isotropic(sample_of(listed, volume, membrane_distance, constants).strained_alike() /
                   (listed.sample_particles > 0 ? listed.sample_volume : volume));
}

}  // namespace hyperlattice
