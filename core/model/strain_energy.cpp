// A spring of direction n and length L has the energy K (L n.e.n)^2 / 2. One site of a layer has
// all forward base springs, one cross spring beside each of them, half of an alpha spring, and the
// volumetric energy of a cell.
#include <model/strain_energy.hpp>

#include <cmath>

namespace hyperlattice {

namespace {

constexpr std::size_t ww = 6;

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
    add(sum, spring.stiffness / (n.rest_length * n.rest_length),
        {x * x, y * y, z * z, y * z, x * z, x * y, 0});
    if (lattice.membrane == KernelChoice::Membrane::none) continue;
    add(sum, spring.cross_stiffness / (n.cross_rest_length * n.cross_rest_length),
        {x * x, y * y, z * z, y * z, x * z, x * y, square});
  }
  if (lattice.volumetric != 0)
    add(sum, lattice.volumetric * std::pow(lattice.spacing, 3), {1, 1, 1, 0, 0, 0, 0});
  sum[ww][ww] += lattice.alpha * square / 2;
  return sum;
}

LayerStiffness layer_stiffness(const InfiniteLattice& lattice, double site_volume) {
  const StrainEnergy energy = strain_energy(lattice);
  const bool relaxes = lattice.membrane == KernelChoice::Membrane::free;
  LayerStiffness stiffness;
  for (std::size_t i = 0; i < ww; ++i)
    for (std::size_t j = 0; j < ww; ++j) {
      const double height = energy[i][ww] * energy[j][ww];  // the part that a free height relaxes
      stiffness[i][j] =
          (energy[i][j] - (relaxes && height != 0 ? height / energy[ww][ww] : 0)) / site_volume;
    }
  return stiffness;
}

ElasticConstants mean_constants(const LayerStiffness& s) {
  const auto mean = [](double a, double b, double c) { return (a + b + c) / 3; };
  return {mean(s[0][0], s[1][1], s[2][2]), mean(s[1][2], s[0][2], s[0][1]),
          mean(s[3][3], s[4][4], s[5][5])};
}

}  // namespace hyperlattice
