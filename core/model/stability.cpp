#include <model/stability.hpp>
#include <model/zone.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <Eigen/Dense>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

using Membrane = KernelChoice::Membrane;

constexpr double round_off = 1e-9;  // relative to the stiffest deformation

/// The energies, N/m, of uniform strains that the lattice can have: a clamped membrane keeps its
/// thickness.
Eigen::MatrixXd homogeneous(const InfiniteLattice& lattice) {
  StrainEnergy energy = strain_energy(lattice);
  double length = 0;
  for (const NeighbourGeometry& n : lattice.neighbours) length = std::max(length, n.rest_length);
  for (auto& row : energy)
    for (double& entry : row) entry /= length * length;
  const Eigen::Index size = lattice.membrane == Membrane::free ? 7 : 6;
  return Eigen::Map<const Eigen::Matrix<double, uniform_strains, uniform_strains>>(energy[0].data())
      .topLeftCorner(size, size);  // symmetric
}

/// How much neighbours move differently: 0 for an endless wave, its square for long ones; with the
/// lattice's symmetry.
double waviness(const InfiniteLattice& lattice, Vec3 q) {
  double sum = 0;
  for (const NeighbourGeometry& n : lattice.neighbours)
    sum += std::pow(std::sin(dot(q, n.rest) / lattice.spacing / 2), 2);
  return sum;
}

}  // namespace

std::optional<Instability> find_instability(const InfiniteLattice& lattice, Sector sector) {
  if (sector == Sector::opposed && lattice.membrane == Membrane::none)
    return std::nullopt;  // two layers that do not know of each other
  const numerics::SymmetricEigen<Eigen::MatrixXd> strains(homogeneous(lattice));
  const double largest = strains.eigenvalues().cwiseAbs().maxCoeff();
  if (sector == Sector::mirrored && strains.eigenvalues()(0) < -round_off * largest) {
    Instability found;
    found.homogeneous = true;
    for (Eigen::Index n = 0; n < strains.eigenvalues().size(); ++n)
      found.strain[static_cast<std::size_t>(n)] = strains.eigenvectors()(n, 0);
    return found;
  }

  // Long mirrored waves are always soft; what counts is their stiffness for their length. Opposed
  // ones have no such limit: uniform displacements shear the membrane, and heights with them turn
  // it, which costs nothing.
  const auto softness = [&](Vec3 q) {
    const double softest = stiffness_range(lattice, q, sector).softest;
    if (sector == Sector::opposed) return -softest;
    const double size = waviness(lattice, q);
    constexpr double too_long =
        1e-4;  // to tell its stiffness from rounding; uniform strains stand for such waves
    return size < too_long ? -infinity : -softest / size;
  };
  const Wave softest = waves(lattice, zone_peak(lattice, softness), sector).front();
  if (softest.stiffness >= -round_off * largest) return std::nullopt;
  Instability found;
  found.wave = softest;
  return found;
}

std::string describe(const Instability& instability) {
  if (!instability.homogeneous) return describe(instability.wave) + ", grows";
  static constexpr std::array<const char*, uniform_strains> names{"xx", "yy", "zz",    "yz",
                                                                  "xz", "xy", "height"};
  std::string mode;
  for (std::size_t n = 0; n < names.size(); ++n)
    if (const double share = instability.strain[n]; std::abs(share) > 0.01)
      mode += fmt::format("{}{} {:.3g}", mode.empty() ? "" : ", ", names[n], share);
  return fmt::format("a homogeneous deformation (wave vector 0; {}) releases energy and grows",
                     mode);
}

}  // namespace hyperlattice
