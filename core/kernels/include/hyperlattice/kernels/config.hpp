// The configuration for which a kernel is compiled. Each class of the kernels is a template of one
// configuration; a class that does not depend on a member is compiled once, for the member's
// default value.
#pragma once

#include <hyperlattice/law.hpp>
#include <hyperlattice/material.hpp>

#include <type_traits>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

using Membrane = KernelChoice::Membrane;
constexpr int components_of(Membrane membrane) { return membrane == Membrane::free ? 4 : 3; }
/// Returns the number of kinds of springs: base, cross.
constexpr std::size_t kinds_of(Membrane membrane) { return membrane == Membrane::none ? 1 : 2; }

enum class Task { step, step_damped, measure };

struct KernelConfig {
  Membrane membrane = Membrane::none;
  Precision stored = Precision::doubles;    ///< precision of displacements and velocities
  Precision computed = Precision::doubles;  ///< precision of forces
  Task task = Task::step;
  bool breakable = false;  ///< springs have alarms
  bool mixed = false;      ///< particles of a row may have several materials
  bool weighted = false;   ///< springs of a row have weights

  constexpr bool measures() const { return task == Task::measure; }
  constexpr int components() const { return components_of(membrane); }

  /// Returns the configuration for the forces of springs, which do not depend on how particles
  /// move.
  constexpr KernelConfig of_springs(bool several_materials, bool by_weights) const {
    KernelConfig config = *this;
    config.task = measures() ? Task::measure : Task::step;
    config.mixed = several_materials;
    config.weighted = by_weights;
    return config;
  }
  /// Returns the configuration for the motion of a row, which does not depend on its springs.
  constexpr KernelConfig of_motion() const {
    KernelConfig config = *this;
    config.breakable = config.weighted = false;
    return config;
  }
  /// Returns the configuration for the places of rows.
  constexpr KernelConfig of_rows() const { return {membrane, stored, computed}; }
};

template <Precision precision>
using NumberOf = std::conditional_t<precision == Precision::floats, float, double>;

/// Measurements are computed in doubles, whatever the precision of the state; so are laws with a
/// memory.
template <class Law>
constexpr KernelConfig config_of(Membrane membrane, bool breakable, bool mixed, Task task,
                                 Precision stored) {
  const bool in_doubles = task == Task::measure || LawWithMemory<Law>;
  return {membrane, stored, in_doubles ? Precision::doubles : stored, task, breakable, mixed};
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
