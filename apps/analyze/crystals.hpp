// Cubic crystals, and the cubic lattices of 18 neighbours that have their elastic constants (figure
// 4 of Zhao 2017, and beyond it: with the stiffnesses, and whether the lattice is stable).
#pragma once

#include <base/errors.hpp>

#include <hyperlattice/calibration.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

struct Crystal {
  std::string name;
  double C11 = 0, C12 = 0, C44 = 0;  ///< any unit, GPa in files
  std::string reliability;  ///< how well the constants are known, as the file says it; may be empty

  double poisson_bulk() const { return C12 / (C11 + C12); }                       ///< nu'
  double poisson_shear() const { return (2 * C44 - C11) / (2 * C44 - 2 * C11); }  ///< nu''
  double zener() const { return 2 * C44 / (C11 - C12); }
};

/// A CSV table with the columns name, C11_GPa, C12_GPa, C44_GPa, and others in any order.
/// InputError with every fault, by line.
std::vector<Crystal> read_crystals(const std::filesystem::path& file);

/// A lattice with a crystal's constants.
struct CrystalFit {
  calibration::Ratios ratios;
  double base_stiffness = 0;  ///< k / l, in the unit of the constants
  bool mirrored = false;      ///< the mirrored lattice is stable
  bool two_layer = false;     ///< so is the one of two layers
};

/// Where the paper looks for k_alpha, k_beta and k_gamma over k.
inline constexpr double least_ratio = -4, most_ratio = 5;

/// The fit with its ratios between these limits: stable in both layers if there is one, else in the
/// mirrored layer, else any; and of those the one with the smallest ratios. Three constants and
/// four stiffnesses leave one number free: k itself. Stable ones need C44 >= C12.
std::optional<CrystalFit> fit(const Crystal& crystal);

}  // namespace hyperlattice
