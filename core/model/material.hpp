// A material of the scene, the criteria that break its springs, and its strength surface.
#pragma once

#include <model/component_pointer.hpp>

#include <hyperlattice/failure.hpp>
#include <hyperlattice/material.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hyperlattice {

struct Material {
  const Stage* stage = nullptr;
  ComponentPointer component;
  MaterialConstants constants;
  std::uint32_t law = 0;          ///< index in SpringTable::laws
  double mass = 0;                ///< mass of a whole particle, kg
  double critical_time_step = 0;  ///< for the infinite lattice of this material, s

  /// A failure criterion of the material's springs.
  struct Criterion {
    const Stage* stage = nullptr;
    ComponentPointer component;
    std::uint32_t number = 0;  ///< among the criteria of all materials
    /// Memory with which each spring starts; see FailureFunctions::start.
    std::array<double, max_failure_memory> start{};
    /// Returns the elongation, m, below which the criterion breaks no such spring.
    double alarm(const SpringFacts& spring) const;
  };
  /// In the order of the scene: the first one that is met breaks a spring. Empty: the springs do
  /// not break.
  std::vector<Criterion> failures;
  /// The surface at which the material's damage grows (model/cohesive.hpp).
  struct Surface {
    const Stage* stage = nullptr;
    ComponentPointer component;
  };
  std::optional<Surface> surface;
  /// Returns the smallest alarm of all criteria, m; infinite without criteria.
  double alarm(const SpringFacts& spring) const;
};

}  // namespace hyperlattice
