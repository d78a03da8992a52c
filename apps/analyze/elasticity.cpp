#include <analyze/elasticity.hpp>
#include <model/strain_energy.hpp>

#include <algorithm>
#include <limits>

namespace hyperlattice {

namespace {

constexpr std::size_t ww = 6;

double mean(double a, double b, double c) { return (a + b + c) / 3; }

/// Returns the distance of the matrix from that of a cubic lattice along the axes.
double cubic_distance(const LatticeElasticity& e) {
  double distance = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      const double cubic = i < 3 && j < 3 ? (i == j ? e.C11 : e.C12) : i == j ? e.C44 : 0;
      distance = std::max(distance, std::abs(e.stiffness[i][j] - cubic));
    }
  return distance;
}

/// Returns the isotropic mean of a listed lattice. C1 to C4 are NaN: they are sums over the springs
/// of one site, which a list does not have.
LatticeElasticity elasticity_of_list(const SpringLattice& lattice) {
  const double unit = lattice.geometry().spacing / lattice.base_stiffness();
  const ElasticConstants constants =
      facts_of(lattice.geometry()).elastic_constants(lattice.constants());
  LatticeElasticity e;
  e.C1 = e.C2 = e.C3 = e.C4 = std::numeric_limits<double>::quiet_NaN();
  e.C11 = unit * constants.C11;
  e.C12 = unit * constants.C12;
  e.C44 = unit * constants.C44;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      e.stiffness[i][j] = i < 3 && j < 3 ? (i == j ? e.C11 : e.C12) : i == j ? e.C44 : 0;
  e.cubic = e.isotropic = true;
  return e;
}

}  // namespace

LatticeElasticity elasticity(const SpringLattice& lattice) {
  if (lattice.geometry().listed) return elasticity_of_list(lattice);
  const InfiniteLattice endless = lattice.endless();
  const double l = lattice.geometry().spacing, k = lattice.base_stiffness();
  const StrainEnergy energy = strain_energy(endless);

  LatticeElasticity e;
  const double both_layers = 2 / (k * l * l);
  e.C1 = both_layers * mean(energy[0][0], energy[1][1], energy[2][2]);
  e.C2 = both_layers * mean(energy[1][2], energy[0][2], energy[0][1]);
  e.C3 = both_layers * energy[ww][ww];
  e.C4 = both_layers * mean(energy[0][ww], energy[1][ww], energy[2][ww]);

  const double unit = l / k;
  e.stiffness = layer_stiffness(endless, lattice.geometry().site_volume);
  for (auto& row : e.stiffness)
    for (double& entry : row) entry *= unit;
  const ElasticConstants constants = mean_constants(e.stiffness);
  e.C11 = constants.C11;
  e.C12 = constants.C12;
  e.C44 = constants.C44;

  constexpr double rounding = 1e-9;
  e.cubic = cubic_distance(e) <= rounding * std::abs(e.C11);
  e.isotropic = e.cubic && std::abs(e.C11 - e.C12 - 2 * e.C44) <= rounding * std::abs(e.C11);
  return e;
}

}  // namespace hyperlattice
