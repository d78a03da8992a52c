// A spring with rest vector R grows by (R.e.R + R.(u_b - u_a)) / |R| under the uniform strain e and the particles' own displacements u; a cross
// spring by (R.e.R + R.(u_b - u_a) + Delta (h_a + h_b)) / sqrt(R^2 + Delta^2), h the heights over the mirror plane's rest. The energy
//   V e.C.e / 2 = e.A.e / 2 - f(e).u + u.K.u / 2
// is least where K u = f(e), which conjugate gradients find for each of six strains; there C = (A - f.u) / V.
#include <model/homogenise.hpp>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr int strains = 6;  // xx, yy, zz, 2 yz, 2 xz, 2 xy
using Strains = Eigen::Matrix<double, strains, 1>;
using Stiffness = Eigen::Matrix<double, strains, strains>;

/// A kind of spring of a particle pair: how its length grows.
struct Growth {
  double stiffness = 0;
  Strains by_strain;
  Vec3 direction;     ///< of b's displacement; a's is opposite
  double height = 0;  ///< of either height
};

class Sample {
 public:
  Sample(std::uint32_t particles, int components)
      : components_(components), size_(static_cast<Eigen::Index>(particles) * components), load_(size_, strains) {
    load_.setZero();
  }

  void add(std::uint32_t a, std::uint32_t b, const Growth& growth) {
    affine_ += growth.stiffness * growth.by_strain * growth.by_strain.transpose();
    common_load_ += growth.stiffness * 2 * growth.height * growth.by_strain;
    common_stiffness_ += growth.stiffness * 4 * growth.height * growth.height;
    if (components_ == 0) return;
    const double of_b[4] = {growth.direction.x, growth.direction.y, growth.direction.z, growth.height};
    for (int c = 0; c < components_; ++c) {
      const double of_a = c == 3 ? of_b[3] : -of_b[c];
      load_.row(at(b, c)) -= growth.stiffness * of_b[c] * growth.by_strain.transpose();
      load_.row(at(a, c)) -= growth.stiffness * of_a * growth.by_strain.transpose();
      for (int d = 0; d < components_; ++d) {
        const double of_a_d = d == 3 ? of_b[3] : -of_b[d];
        entry(b, c, b, d, growth.stiffness * of_b[c] * of_b[d]);
        entry(a, c, a, d, growth.stiffness * of_a * of_a_d);
        entry(a, c, b, d, growth.stiffness * of_a * of_b[d]);
        entry(b, c, a, d, growth.stiffness * of_b[c] * of_a_d);
      }
    }
  }
  void add_alpha(std::uint32_t particle, double alpha) {
    common_stiffness_ += 2 * alpha;
    if (components_ == 4) entry(particle, 3, particle, 3, 2 * alpha);
  }

  /// Times the volume; all particles strained alike, with one height for all.
  Stiffness strained_alike() const {
    if (common_stiffness_ == 0) return affine_;
    return affine_ - common_load_ * common_load_.transpose() / common_stiffness_;
  }

  /// Times the volume; each particle at its own rest.
  Stiffness relaxed() const {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(size_, size_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(1e-9);  // its square is the error of the energy
    solver.setMaxIterations(20000);
    solver.compute(matrix);
    Stiffness found = affine_;
    for (int e = 0; e < strains; ++e) {
      const Eigen::VectorXd moved = solver.solve(load_.col(e));
      if (solver.info() != Eigen::Success)
        throw std::invalid_argument("the lattice's springs make no solid: its sample finds no rest under a strain");
      found.row(e) -= moved.transpose() * load_;
    }
    return 0.5 * (found + found.transpose());
  }

 private:
  Eigen::Index at(std::uint32_t particle, int c) const { return static_cast<Eigen::Index>(particle) * components_ + c; }
  void entry(std::uint32_t a, int c, std::uint32_t b, int d, double value) {
    entries_.emplace_back(static_cast<int>(at(a, c)), static_cast<int>(at(b, d)), value);
  }

  int components_;
  Eigen::Index size_;
  Eigen::Matrix<double, Eigen::Dynamic, strains> load_;
  std::vector<Eigen::Triplet<double>> entries_;
  Stiffness affine_ = Stiffness::Zero();
  Strains common_load_ = Strains::Zero();
  double common_stiffness_ = 0;
};

Growth growth_of(Vec3 rest, double length, double height, double stiffness) {
  const double n = 1 / length;
  Growth growth;
  growth.stiffness = stiffness;
  growth.by_strain << n * rest.x * rest.x, n * rest.y * rest.y, n * rest.z * rest.z, n * rest.y * rest.z, n * rest.x * rest.z, n * rest.x * rest.y;
  growth.direction = n * rest;
  growth.height = n * height;
  return growth;
}

/// The isotropic constants nearest to these in Voigt's sense.
ElasticConstants isotropic(const Stiffness& c) {
  const double C11 = (c(0, 0) + c(1, 1) + c(2, 2)) / 3, C12 = (c(0, 1) + c(0, 2) + c(1, 2)) / 3, C44 = (c(3, 3) + c(4, 4) + c(5, 5)) / 3;
  const double bulk = (C11 + 2 * C12) / 3, shear = (C11 - C12 + 3 * C44) / 5;
  return {bulk + 4 * shear / 3, bulk - 2 * shear / 3, shear};
}

}  // namespace

ElasticConstants homogenise(const Listed& listed, double volume, double membrane_distance, const MaterialConstants& constants) {
  const bool has_sample = listed.sample_particles > 0, cross = constants.has_cross_springs(), free = cross && !constants.clamped;
  const std::uint32_t particles = has_sample ? listed.sample_particles : static_cast<std::uint32_t>(listed.positions.size());
  Sample sample(particles, has_sample ? (free ? 4 : 3) : 0);
  const auto add = [&](std::uint32_t a, std::uint32_t b, Vec3 rest, double factor) {
    const double k = factor * constants.base_stiffness, length = norm(rest);
    sample.add(a, b, growth_of(rest, length, 0, k));
    if (cross) sample.add(a, b, growth_of(rest, std::hypot(length, membrane_distance), free ? membrane_distance : 0, constants.cross_ratio[0] * k));
  };
  for (const SampleSpring& spring : listed.sample) add(spring.a, spring.b, spring.rest, spring.stiffness);
  if (!has_sample)
    for (const ListedSpring& spring : listed.springs)
      add(spring.a, spring.b, listed.positions[spring.b] - listed.positions[spring.a], spring.stiffness);
  if (free)
    for (std::uint32_t p = 0; p < particles; ++p) sample.add_alpha(p, constants.alpha_ratio * constants.base_stiffness);
  return isotropic(has_sample ? Stiffness(sample.relaxed() / listed.sample_volume) : Stiffness(sample.strained_alike() / volume));
}

}  // namespace hyperlattice
