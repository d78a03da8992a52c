// What is said of crystals and the lattices that have their constants: for machines, as a table,
// and as the map of figure 4.
#pragma once

#include <analyze/crystals.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// Constants in GPa.
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

/// The map in gnuplot's commands: which pairs nu', nu'' lattices with ratios from -4 to 5 have at
/// all, and which stable ones; the paper's membranes; the crystals; and `lattice`, the one
/// analysed, if there is one.
std::string crystal_map_script(const std::vector<FittedCrystal>& crystals,
                               const std::optional<MapPoint>& lattice);

}  // namespace hyperlattice
