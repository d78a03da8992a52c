// The contracts of the families: what every component must do, whatever it is for, and whoever wrote it. Each is checked with the component's
// example (scene/examples.hpp) in small scenes, by the ordinary runtime; `hyperlattice plugins --test` prints what was found.
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

/// Runs the component through its family's contract. `host` must also find the built-in components that stand around it in the scenes.
/// `pictures`: folder for <type>.svg of those that have a picture, made if need be; empty: none is drawn. Never throws for what a component does.
std::vector<Check> check(const Component& component, Host& host, const std::filesystem::path& pictures = {});

}  // namespace hyperlattice::contract
