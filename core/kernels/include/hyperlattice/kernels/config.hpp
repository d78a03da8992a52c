// The configuration for which a kernel is compiled. Each class of the kernels is a template of one
// configuration; a class that does not depend on a member is compiled once, for the member's
// default value.
#pragma once

#include <hyperlattice/kernel_set.hpp>
#include <hyperlattice/law.hpp>

#include <type_traits>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

using Membrane = KernelChoice::Membrane;
constexpr int components_of(Membrane membrane) { return membrane == Membrane::free ? 4 : 3; }
/// Returns the number of kinds of springs: base, cross.
constexpr std::size_t kinds_of(Membrane membrane) { return membrane == Membrane::none ? 1 : 2; }

enum class Task { step, measure };

struct KernelConfig {
  Membrane membrane = Membrane::none;
  Precision stored = Precision::doubles;    ///< precision of displacements and velocities
  Precision computed = Precision::doubles;  ///< precision of forces
  Task task = Task::step;

  constexpr bool measures() const { return task == Task::measure; }
  constexpr int components() const { return components_of(membrane); }

  /// Returns the configuration for the places of rows, which do not depend on the task.
  constexpr KernelConfig of_rows() const { return {membrane, stored, computed}; }
};

template <Precision precision>
using NumberOf = std::conditional_t<precision == Precision::floats, float, double>;

/// Measurements are computed in doubles, whatever the precision of the state; so are laws with a
/// memory.
template <class Law>
constexpr KernelConfig config_of(Membrane membrane, Precision stored, Task task) {
  const bool in_doubles = task == Task::measure || LawWithMemory<Law>;
  return {membrane, stored, in_doubles ? Precision::doubles : stored, task};
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
