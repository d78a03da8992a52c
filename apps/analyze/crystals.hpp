// Cubic crystals, and the cubic lattices of 18 neighbours with the same elastic constants: figure 4
// of Zhao 2017, with the stiffnesses and the stability in addition.
#pragma once

#include <base/errors.hpp>

#include <hyperlattice/calibration.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// A cubic crystal with its elastic constants.
struct Crystal {
  std::string name;
  double C11 = 0, C12 = 0, C44 = 0;  ///< GPa in files; any common unit elsewhere
  std::string reliability;  ///< how well the constants are known, text of the file; may be empty

  double poisson_bulk() const { return C12 / (C11 + C12); }                       ///< nu'
  double poisson_shear() const { return (2 * C44 - C11) / (2 * C44 - 2 * C11); }  ///< nu''
  double zener() const { return 2 * C44 / (C11 - C12); }
};

/// Reads a CSV table with the columns name, C11_GPa, C12_GPa, C44_GPa; further columns and any
/// order are allowed. Throws InputError with every fault and its line.
std::vector<Crystal> read_crystals(const std::filesystem::path& file);

/// A cubic lattice with the elastic constants of a crystal.
struct CrystalFit {
  calibration::Ratios ratios;
  double base_stiffness = 0;  ///< k / l, in the unit of the constants
  bool mirrored = false;      ///< the mirrored lattice is stable
  bool two_layer = false;     ///< the two-layer lattice is stable too
};

/// The range of k_alpha / k, k_beta / k and k_gamma / k in the paper.
inline constexpr double least_ratio = -4, most_ratio = 5;

/// Returns a lattice with the crystal's constants and with ratios between these limits; nothing if
/// there is none. Three constants and four stiffnesses leave one free number, k. A lattice that is
/// stable in both layers comes first, then one with a stable mirrored layer, then any; among
/// equals, the smallest ratios win. A stable lattice needs C44 >= C12.
std::optional<CrystalFit> fit(const Crystal& crystal);

}  // namespace hyperlattice
