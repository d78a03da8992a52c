// Keys that the core adds to every component of a family, declared like the component's own
// options.
#pragma once

#include <base/option_set.hpp>

namespace hyperlattice {

/// The values of these keys; each family declares only some of them.
struct CommonOptions {
  std::optional<std::string> name;
  RegionId region;
  std::optional<double> record_every, every;
  std::optional<double> mass_scaling;
  double energy_tolerance = 0, approach_limit = 0, growth_limit = 0, momentum_tolerance = 0;
  bool first = true, last = true;
};

/// Returns the common options of a stage of the family, for objects of type CommonOptions. The
/// family failures has none.
const OptionSet& common_options(Family family);

/// Help text of the scene's key "allow_unstable".
inline constexpr std::string_view allow_unstable_help =
    "run lattices of which some deformation grows by itself, with a warning that names it, instead "
    "of refusing them";

/// Values of the scene's key "precision", in the order of hyperlattice::Precision.
inline constexpr std::string_view precision_names[] = {"double", "float"};
inline constexpr std::string_view precision_help =
    "numbers that the state is stored in and steps are computed with: float takes half the memory "
    "and less time, with errors near 1e-6 "
    "of the largest displacement; energies are summed in doubles";

/// Values of the scene's key "interface_springs", in the order of InterfaceSprings.
inline constexpr std::string_view interface_springs_names[] = {"series", "softer", "stiffer"};
inline constexpr std::string_view interface_springs_help =
    "springs between particles of two materials: two half springs in series, each with its own "
    "material's law and strength, or a whole spring of the softer or of the stiffer material; not "
    "used by bodies of cells, whose springs have the materials of their cells side by side";

/// Help text of a material's key "failure", which is no plain option.
inline constexpr std::string_view failure_help =
    "criterion by which springs break: an object with the type of a component of the family "
    "failures, or a list of such objects, of which the first that is met breaks a spring; "
    "unbreakable if left out";

/// Returns the family that a type begins with ("loads"); nothing if no family has that name.
std::optional<Family> family_of(std::string_view type);
inline std::string_view family_name(Family family) {
  return family_names[static_cast<std::size_t>(family)];
}

}  // namespace hyperlattice
