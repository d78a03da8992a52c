// What a kernel is compiled for. Each class of the kernels is a template of one configuration;
// parts that do not depend on a member of it are compiled once, for its default value.
#pragma once

#include <hyperlattice/law.hpp>
#include <hyperlattice/material.hpp>

#include <type_traits>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

using Membrane = KernelChoice::Membrane;
constexpr int components_of(Membrane membrane) { return membrane == Membrane::free ? 4 : 3; }
constexpr std::size_t kinds_of(Membrane membrane) {
  return membrane == Membrane::none ? 1 : 2;
}  // of springs: base, cross

enum class Task { step, step_damped, measure };

struct KernelConfig {
  Membrane membrane = Membrane::none;
  Precision stored = Precision::doubles;    ///< of displacements and velocities
  Precision computed = Precision::doubles;  ///< of forces
  Task task = Task::step;
  bool breakable = false;  ///< springs have alarms
  bool mixed = false;      ///< particles of a row may be of several materials
  bool weighted = false;   ///< springs of a row count by weights

  constexpr bool measures() const { return task == Task::measure; }
  constexpr int components() const { return components_of(membrane); }

  /// Of the forces of springs: these do not depend on how particles move.
  constexpr KernelConfig of_springs(bool several_materials, bool by_weights) const {
    KernelConfig config = *this;
    config.task = measures() ? Task::measure : Task::step;
    config.mixed = several_materials;
    config.weighted = by_weights;
    return config;
  }
  /// Of the motion of a row, which does not depend on what its springs are.
  constexpr KernelConfig of_motion() const {
    KernelConfig config = *this;
    config.breakable = config.weighted = false;
    return config;
  }
  /// Of where rows stand.
  constexpr KernelConfig of_rows() const { return {membrane, stored, computed}; }
};

template <Precision precision>
using NumberOf = std::conditional_t<precision == Precision::floats, float, double>;

/// What is measured is computed in doubles, whatever the state is stored in; so is what a law with
/// constants of its own does.
template <class Law>
constexpr KernelConfig config_of(Membrane membrane, bool breakable, bool mixed, Task task,
                                 Precision stored) {
  const bool in_doubles = task == Task::measure || LawWithConstants<Law>;
  return {membrane, stored, in_doubles ? Precision::doubles : stored, task, breakable, mixed};
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
