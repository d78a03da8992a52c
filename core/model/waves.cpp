// With q the wave vector, radians per spacing, and theta = q . r / l for a neighbour at r, a base
// spring contributes to the dynamical matrix
//   4 k sin^2(theta/2) n n^T,                                 n = r / |r|,
// and a cross spring, which joins the two layers,
//   4 k_c w w^T,   mirrored: w = (r sin(theta/2), Delta cos(theta/2)) / sqrt(r^2 + Delta^2)
//                  opposed:  w = (r cos(theta/2), Delta sin(theta/2)) / sqrt(r^2 + Delta^2)
// (the height lags by a quarter of a period, which makes the Hermitian matrix real). The alpha
// spring contributes 2 k_alpha to a mirrored height. The volumetric energy of cells contributes
//   4 K_v l g g^T,   g_x = sin(q_x/2) cos(q_y/2) cos(q_z/2), and so on.
#include <model/waves.hpp>
#include <model/zone.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <Eigen/Dense>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
using Modes = numerics::SymmetricEigen<Matrix>;
using Membrane = KernelChoice::Membrane;

double phase_of(const InfiniteLattice& lattice, Vec3 q, const NeighbourGeometry& n) {
  return dot(q, n.rest) / lattice.spacing;
}

Matrix dynamical_matrix(const InfiniteLattice& lattice, Vec3 q, Sector sector) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const NeighbourGeometry& n : lattice.neighbours) {
    const SpringConstants& spring = lattice.springs[n.site.spring_class];
    const double half = phase_of(lattice, q, n) / 2, sine = std::sin(half), cosine = std::cos(half);
    const Eigen::Vector4d base =
        Eigen::Vector4d(n.rest.x, n.rest.y, n.rest.z, 0) * (sine / n.rest_length);
    sum += 4 * spring.stiffness * base * base.transpose();
    if (lattice.membrane == Membrane::none) continue;
    const double in_space = sector == Sector::mirrored ? sine : cosine,
                 in_height = sector == Sector::mirrored ? cosine : sine;
    const Eigen::Vector4d cross =
        Eigen::Vector4d(n.rest.x * in_space, n.rest.y * in_space, n.rest.z * in_space,
                        lattice.membrane_distance * in_height) /
        n.cross_rest_length;
    sum += 4 * spring.cross_stiffness * cross * cross.transpose();
  }
  if (sector == Sector::mirrored) sum(3, 3) += 2 * lattice.alpha;
  if (lattice.volumetric != 0) {
    const Vec3 half = 0.5 * q, c{std::cos(half.x), std::cos(half.y), std::cos(half.z)};
    const Eigen::Vector4d growth{std::sin(half.x) * c.y * c.z, c.x * std::sin(half.y) * c.z,
                                 c.x * c.y * std::sin(half.z), 0};
    sum += 4 * lattice.volumetric * lattice.spacing * growth * growth.transpose();
  }
  const int size = lattice.membrane == Membrane::free ? 4 : 3;
  return sum.topLeftCorner(size, size);
}

/// Returns the wave of one eigenvector, with the sign that makes its largest component positive.
Wave wave(const Modes& found, Vec3 q, Eigen::Index mode, Sector sector) {
  Eigen::VectorXd motion = found.eigenvectors().col(mode);
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  if (motion(largest) < 0) motion = -motion;
  return {q,
          found.eigenvalues()(mode),
          {motion(0), motion(1), motion(2)},
          motion.size() == 4 ? motion(3) : 0,
          sector};
}

}  // namespace

std::vector<Wave> waves(const InfiniteLattice& lattice, Vec3 q, Sector sector) {
  const Modes found(dynamical_matrix(lattice, q, sector));
  std::vector<Wave> all;
  for (Eigen::Index mode = 0; mode < found.eigenvalues().size(); ++mode)
    all.push_back(wave(found, q, mode, sector));
  return all;
}

StiffnessRange stiffness_range(const InfiniteLattice& lattice, Vec3 q, Sector sector) {
  const Modes found(dynamical_matrix(lattice, q, sector), Eigen::EigenvaluesOnly);
  return {found.eigenvalues()(0), found.eigenvalues()(found.eigenvalues().size() - 1)};
}

Wave stiffest_wave(const InfiniteLattice& lattice) {
  const Vec3 q = zone_peak(
      lattice, [&](Vec3 at) { return stiffness_range(lattice, at, Sector::mirrored).stiffest; });
  return waves(lattice, q, Sector::mirrored).back();
}

std::string describe(const Wave& wave) {
  const auto angle = [](double radians) {
    const double turns = radians / pi, whole = std::round(turns);
    if (std::abs(turns - whole) > 1e-4) return fmt::format("{:.3f} pi", turns);
    return whole == 0             ? std::string("0")
           : std::abs(whole) == 1 ? std::string(whole < 0 ? "-pi" : "pi")
                                  : fmt::format("{:.0f} pi", whole);
  };
  const auto share = [](double part) {
    return fmt::format("{:.3g}", std::abs(part) < 1e-4 ? 0 : part);
  };
  const bool in_space = norm(wave.direction) > 1e-4;
  std::string motion = in_space ? fmt::format("along ({}, {}, {})", share(wave.direction.x),
                                              share(wave.direction.y), share(wave.direction.z))
                                : "";
  if (in_space && wave.sector == Sector::opposed) motion += ", the two layers oppositely,";
  if (std::abs(wave.height) > 1e-4)
    motion += in_space ? fmt::format(" and by {} in the fourth dimension", share(wave.height))
                       : "in the fourth dimension";
  if (motion.ends_with(',')) motion.pop_back();
  return fmt::format("the wave with vector ({}, {}, {}) a spacing, moving {}", angle(wave.vector.x),
                     angle(wave.vector.y), angle(wave.vector.z), motion);
}

}  // namespace hyperlattice
