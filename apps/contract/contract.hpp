// The contracts of the families: what every component must do, whatever it is for, and whoever
// wrote it. Each is checked with the component's example (scene/examples.hpp) in small scenes, by
// the ordinary runtime; `hyperlattice plugins --test` prints what was found.
#pragma once

#include <host/host.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice::contract {

enum class Verdict { passed, failed, not_applicable };
inline constexpr std::string_view verdict_names[] = {"passed", "failed", "not applicable"};

/// What one check found.
struct Check {
  std::string name;
  Verdict verdict = Verdict::passed;
  std::string detail;  ///< figures, what is wrong, or why it does not apply
};

/// The types of the components that stand around the one under test in the scenes.
struct Surroundings {
  std::string
      grid;  ///< a structured lattice of cubic cells, with the options spacing, shape, boundary
  std::string list;          ///< a lattice that is a list of springs: spacing, shape
  std::string material;      ///< an elastic solid: young, poisson, density, membrane
  std::string failure;       ///< springs that break at an elongation: limit
  std::string displacement;  ///< a load that leads particles: on, value, axes, rise
  std::string steps;         ///< a solver that steps in time: end_time
};

/// Runs the component through its family's contract. `host` must also find those around it.
/// `pictures`: folder for <type>.svg of those that have a picture, made if need be; empty: none is
/// drawn. Never throws for what a component does.
std::vector<Check> check(const Component& component, Host& host, const Surroundings& around,
                         const std::filesystem::path& pictures = {});

}  // namespace hyperlattice::contract
