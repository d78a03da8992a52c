// A spring of direction n and length L takes up K (L n.e.n)^2 / 2. A site of a layer has every forward base spring, one cross spring beside
// each, and half of its alpha spring.
#include <model/strain_energy.hpp>

namespace hyperlattice {

namespace {

void add(StrainEnergy& sum, double factor, const std::array<double, uniform_strains>& stretch) {
  for (std::size_t i = 0; i < uniform_strains; ++i)
    for (std::size_t j = 0; j < uniform_strains; ++j) sum[i][j] += factor * stretch[i] * stretch[j];
}

}  // namespace

StrainEnergy strain_energy(const InfiniteLattice& lattice) {
  StrainEnergy sum{};
  const double square = lattice.membrane_distance * lattice.membrane_distance;
  for (const NeighbourGeometry& n : lattice.neighbours) {
    const SpringConstants& spring = lattice.springs[n.site.spring_class];
    const auto [x, y, z] = n.rest;
    add(sum, spring.stiffness / (n.rest_length * n.rest_length), {x * x, y * y, z * z, y * z, x * z, x * y, 0});
    if (lattice.membrane == KernelChoice::Membrane::none) continue;
    add(sum, spring.cross_stiffness / (n.cross_rest_length * n.cross_rest_length), {x * x, y * y, z * z, y * z, x * z, x * y, square});
  }
  sum[6][6] += lattice.alpha * square / 2;
  return sum;
}

}  // namespace hyperlattice
