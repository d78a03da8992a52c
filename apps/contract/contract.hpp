// The contract of each family: checks that every component of the family must pass. The runtime
// runs each check with the component's example (scene/examples.hpp) in small scenes; `hyperlattice
// plugins --test` prints the results.
#pragma once

#include <host/host.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice::contract {

enum class Verdict { passed, failed, not_applicable };
inline constexpr std::string_view verdict_names[] = {"passed", "failed", "not applicable"};

/// The result of one check.
struct Check {
  std::string name;
  Verdict verdict = Verdict::passed;
  std::string detail;  ///< numbers, the fault, or why the check does not apply
};

/// The types of the other components in the scenes of the component under test.
struct OtherComponents {
  std::string grid;      ///< a structured lattice of cubic cells; options: spacing, shape, boundary
  std::string list;      ///< a lattice that is a list of springs; options: spacing, shape
  std::string material;  ///< an elastic solid; options: young, poisson, density, membrane
  std::string failure;   ///< springs that break at an elongation; option: limit
  /// A load with a prescribed displacement; options: on, value, axes, rise.
  std::string displacement;
  std::string steps;  ///< a solver that steps in time; option: end_time
};

/// Runs all checks of the component's family. `host` must also find the components of `around`.
/// Writes a picture <type>.svg into the folder `pictures`, which is created if needed; an empty
/// path: no pictures. Never throws because of an error in the component; such an error is a failed
/// check.
std::vector<Check> check(const Component& component, Host& host, const OtherComponents& around,
                         const std::filesystem::path& pictures = {});

}  // namespace hyperlattice::contract
