// Reports on crystals and on the lattices with their elastic constants: as JSON, as a table, and as
// the map of figure 4 (Zhao 2017).
#pragma once

#include <analyze/crystals.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// A crystal (constants in GPa) and its lattice, if one exists.
struct FittedCrystal {
  Crystal crystal;
  std::optional<CrystalFit> fit;
};
std::vector<FittedCrystal> fit_all(const std::vector<Crystal>& crystals);

Json crystals_json(const std::vector<FittedCrystal>& crystals);
std::string crystals_text(const std::vector<FittedCrystal>& crystals);

/// A point on the map of figure 4: nu' and nu''.
struct MapPoint {
  double poisson_bulk = 0, poisson_shear = 0;
};

/// Returns the map as gnuplot commands: the pairs nu', nu'' for which lattices with ratios from -4
/// to 5 exist, and those for which a stable one exists; the membranes of the paper; the crystals;
/// and the analysed `lattice`, if given.
std::string crystal_map_script(const std::vector<FittedCrystal>& crystals,
                               const std::optional<MapPoint>& lattice);

}  // namespace hyperlattice
