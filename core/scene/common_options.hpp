// Keys that the core adds to every component of a family, declared like the components' own.
#pragma once

#include <base/option_set.hpp>

namespace hyperlattice {

struct CommonOptions {
  std::optional<std::string> name;
  RegionId region;
  std::optional<double> record_every, every;
  double energy_tolerance = 0;
  bool first = true, last = true;
};

/// Those of a stage of the family; the options are CommonOptions. Failures have none.
const OptionSet& common_options(Family family);

/// The top level's key for lattices that are not stable.
inline constexpr std::string_view allow_unstable_help =
    "run lattices of which some deformation grows by itself, with a warning that names it, instead "
    "of refusing them";

/// The top level's key for the numbers that the state is stored in. Names are those of
/// hyperlattice::Precision.
inline constexpr std::string_view precision_names[] = {"double", "float"};
inline constexpr std::string_view precision_help =
    "numbers that the state is stored in and steps are computed with: float takes half the memory "
    "and less time, with errors near 1e-6 "
    "of the largest displacement; energies are summed in doubles";

/// What a material's "failure" holds; it is no plain option.
inline constexpr std::string_view failure_help =
    "criterion by which springs break: an object with the type of a component of the family "
    "failures; unbreakable if left out";

/// Family of a type's first part ("loads"), if there is one of that name.
std::optional<Family> family_of(std::string_view type);
inline std::string_view family_name(Family family) {
  return family_names[static_cast<std::size_t>(family)];
}

}  // namespace hyperlattice
