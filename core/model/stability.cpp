#include <model/stability.hpp>
#include <model/zone.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <Eigen/Dense>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

using Membrane = KernelChoice::Membrane;

constexpr double round_off = 1e-9;  // relative to the stiffest deformation

/// Returns the energies, N/m, of the uniform strains that the lattice can have. A clamped membrane
/// keeps its thickness.
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

/// Returns a measure of the different motion of neighbours: 0 for infinite wavelength, proportional
/// to q^2 for long waves. It has the symmetry of the lattice.
double waviness(const InfiniteLattice& lattice, Vec3 q) {
  double sum = 0;
  for (const NeighbourGeometry& n : lattice.neighbours)
    sum += std::pow(std::sin(dot(q, n.rest) / lattice.spacing / 2), 2);
  return sum;
}

}  // namespace

std::optional<Instability> find_instability(const InfiniteLattice& lattice, Sector sector) {
  if (sector == Sector::opposed && lattice.membrane == Membrane::none)
    return std::nullopt;  // the two layers are not connected
  const numerics::SymmetricEigen<Eigen::MatrixXd> strains(homogeneous(lattice));
  const double largest = strains.eigenvalues().cwiseAbs().maxCoeff();
  if (sector == Sector::mirrored && strains.eigenvalues()(0) < -round_off * largest) {
    Instability found;
    found.homogeneous = true;
    for (Eigen::Index n = 0; n < strains.eigenvalues().size(); ++n)
      found.strain[static_cast<std::size_t>(n)] = strains.eigenvectors()(n, 0);
    return found;
  }

  // Long mirrored waves are always soft, so their stiffness is divided by their waviness. Opposed
  // waves have no such limit: uniform displacements shear the membrane; together with heights they
  // rotate it, which costs no energy.
  const auto softness = [&](Vec3 q) {
    const double softest = stiffness_range(lattice, q, sector).softest;
    if (sector == Sector::opposed) return -softest;
    const double size = waviness(lattice, q);
    // Longer waves have a stiffness within round-off; the uniform strains replace them.
    constexpr double too_long = 1e-4;
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
