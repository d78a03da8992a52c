// A law: the force (N) and the energy (J) of one spring from its elongation. There are two kinds,
// both scalar; the kernels that apply a law to a lattice come from kernels/.
//
// 1. Without memory. Two templates, which take numbers as well as vectors of numbers:
//
//      struct Linear {
//        static constexpr bool linear = true;  // only if force is proportional to elongation
//        template <class Real> static Real force(Real stiffness, Real elongation) {
//          return stiffness * elongation;
//        }
//        template <class Real> static Real energy(Real stiffness, Real elongation) {
//          return stiffness * elongation * elongation / 2;
//        }
//      };
//
// 2. With its own constants and, if needed, a memory: numbers that each spring keeps from step to
// step. Ordinary code, if and else included:
//
//      struct Slider {
//        // Doubles only; the material sets them in MaterialConstants::law.
//        struct Constants { double limit; };
//        // Doubles only; all zero at the start of the run if there is no start().
//        struct Memory { double slipped = 0; };
//        // Only for springs whose memory does not start at zero.
//        static Memory start(const Constants& c, const SpringIdentity& spring);
//        // Called once a step, before force().
//        static void update(const SpringState& s, const Constants& c, Memory& m);
//        // N, positive if the spring pulls.
//        static double force(const SpringState& s, const Constants& c, const Memory& m);
//        // Recoverable energy, J.
//        static double energy(const SpringState& s, const Constants& c, const Memory& m);
//      };
//
//    The core computes the dissipated energy: the work of the force less the change of the energy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace hyperlattice {

/// A spring at one instant.
struct SpringState {
  double stiffness = 0;    ///< N/m
  double rest_length = 0;  ///< m
  double elongation = 0;   ///< m
  double rate = 0;         ///< rate of the elongation over the last step, m/s; 0 at the start
  double time_step = 0;    ///< length of the last step, s; 0 at the start
};

/// The particles at the ends of a base spring, a < b, numbered as the lattice names them. A cross
/// spring has the identity of its base spring.
struct SpringIdentity {
  std::uint64_t a = 0, b = 0;
};

inline constexpr std::size_t max_law_constants = 8, max_law_memory = 6;

/// A law of the second kind.
template <class Law>
concept LawWithConstants = requires {
  typename Law::Constants;
};
template <class Law>
concept LawWithMemory = LawWithConstants<Law> && requires {
  typename Law::Memory;
};
template <class Law>
concept LawWithStart = LawWithMemory<Law> &&
    requires(const typename Law::Constants& constants, const SpringIdentity& spring) {
  Law::start(constants, spring);
};

/// Returns how many doubles a struct of doubles holds.
template <class Struct>
constexpr std::size_t numbers_in() {
  if constexpr (std::is_empty_v<Struct>) return 0;
  static_assert(std::is_empty_v<Struct> || sizeof(Struct) % sizeof(double) == 0, "doubles only");
  return sizeof(Struct) / sizeof(double);
}

/// Returns how many numbers each spring keeps: the law's own, then the last elongation and force,
/// from which rate and work follow. A law that needs only the rate has an empty Memory.
template <class Law>
constexpr std::size_t memory_of() {
  if constexpr (LawWithMemory<Law>) {
    static_assert(numbers_in<typename Law::Memory>() <= max_law_memory);
    return numbers_in<typename Law::Memory>() + 2;
  } else {
    return 0;
  }
}

/// Result of one step of a spring with a law of the second kind.
template <LawWithConstants Law>
struct SpringStep {
  static constexpr std::size_t own = memory_of<Law>() > 0 ? memory_of<Law>() - 2 : 0;

  double force = 0;       ///< N
  double energy = 0;      ///< J
  double dissipated = 0;  ///< J, during the last step

  /// Returns the stored energy, J, for the present memory.
  static double energy_of(const SpringState& state, const double* constants,
                          const double* memory) requires LawWithMemory<Law> {
    return Law::energy(state, read<typename Law::Constants>(constants),
                       read<typename Law::Memory>(memory));
  }

  /// Sets the memory of a new spring.
  static void start(const double* constants, const SpringIdentity& spring,
                    double* memory) requires LawWithStart<Law> {
    const typename Law::Memory begun = Law::start(read<typename Law::Constants>(constants), spring);
    std::memcpy(memory, &begun, own * sizeof(double));
  }

  /// Advances a spring by one step. `constants`: the law's; `memory`: memory_of<Law>() numbers, in:
  /// values at the previous step, out: values at the current step.
  static SpringStep take(SpringState state, const double* constants, double* memory) {
    const auto own_constants = read<typename Law::Constants>(constants);
    SpringStep step;
    if constexpr (LawWithMemory<Law>) {
      auto own_memory = read<typename Law::Memory>(memory);
      double& last_elongation = memory[own];
      double& last_force = memory[own + 1];
      SpringState before = state;
      before.elongation = last_elongation;
      const double energy_before = Law::energy(before, own_constants, own_memory),
                   stretched = state.elongation - last_elongation;
      state.rate = state.time_step > 0 ? stretched / state.time_step : 0;
      Law::update(state, own_constants, own_memory);
      step.force = Law::force(state, own_constants, own_memory);
      step.energy = Law::energy(state, own_constants, own_memory);
      step.dissipated = 0.5 * (last_force + step.force) * stretched - (step.energy - energy_before);
      std::memcpy(memory, &own_memory, own * sizeof(double));
      last_elongation = state.elongation;
      last_force = step.force;
    } else {
      step.force = Law::force(state, own_constants);
      step.energy = Law::energy(state, own_constants);
    }
    return step;
  }

 private:
  template <class Struct>
  static Struct read(const double* numbers) {
    static_assert(numbers_in<Struct>() <= max_law_constants);
    Struct read;
    std::memcpy(&read, numbers, numbers_in<Struct>() * sizeof(double));
    return read;
  }
};

}  // namespace hyperlattice
