// A law: what one spring does. Two kinds, both plain scalar physics; the kernels that run it over a
// lattice come from kernels/.
//
// 1. Without memory. Two templates, so that they work on a number as on a vector of them:
//
//      struct Linear {
//        static constexpr bool linear = true;  // only if the force is proportional to the
//        elongation template <class Real> static Real force(Real stiffness, Real elongation) {
//        return stiffness * elongation; } template <class Real> static Real energy(Real stiffness,
//        Real elongation) { return stiffness * elongation * elongation / 2; }
//      };
//
// 2. With constants of its own and, if it has any, a memory: numbers that each spring keeps from
// step to step. Ordinary code, if and else included:
//
//      struct Slider {
//        struct Constants { double limit; };         // doubles only; what MaterialConstants::law
//        holds struct Memory { double slipped = 0; };      // doubles only; all zero at first, if
//        there is no start() static Memory start(const Constants& c, const SpringIdentity& spring);
//        // for springs that differ from the beginning static void update(const SpringState& s,
//        const Constants& c, Memory& m);         // once a step, before the force is asked for
//        static double force(const SpringState& s, const Constants& c, const Memory& m);  // N,
//        positive if the spring pulls static double energy(const SpringState& s, const Constants&
//        c, const Memory& m); // J that it would give back
//      };
//
//    What the spring dissipates need not be said: it is the work of its force less the change of
//    its energy.
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
  double rate = 0;         ///< of the elongation over the step before now, m/s; 0 at the start
  double time_step = 0;    ///< the step before now, s; 0 at the start
};

/// Which spring it is, or a cross spring beside it: the particles at its ends, a < b, in the order
/// in which the lattice names them.
struct SpringIdentity {
  std::uint64_t a = 0, b = 0;
};

inline constexpr std::size_t max_law_constants = 8, max_law_memory = 6;

/// Whether a law is of the second kind.
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

/// Numbers in a struct of doubles.
template <class Struct>
constexpr std::size_t numbers_in() {
  if constexpr (std::is_empty_v<Struct>) return 0;
  static_assert(std::is_empty_v<Struct> || sizeof(Struct) % sizeof(double) == 0, "doubles only");
  return sizeof(Struct) / sizeof(double);
}

/// Numbers that each spring keeps: the law's own, and its last elongation and force, of which rate
/// and work follow. A law that needs no number of its own but the rate has an empty Memory.
template <class Law>
constexpr std::size_t memory_of() {
  if constexpr (LawWithMemory<Law>) {
    static_assert(numbers_in<typename Law::Memory>() <= max_law_memory);
    return numbers_in<typename Law::Memory>() + 2;
  } else {
    return 0;
  }
}

/// One spring of a law of the second kind from the step before to now.
template <LawWithConstants Law>
struct SpringStep {
  static constexpr std::size_t own = memory_of<Law>() > 0 ? memory_of<Law>() - 2 : 0;

  double force = 0;       ///< N
  double energy = 0;      ///< J
  double dissipated = 0;  ///< J since the step before

  /// J that the spring has stored, with the memory as it is.
  static double energy_of(const SpringState& state, const double* constants,
                          const double* memory) requires LawWithMemory<Law> {
    return Law::energy(state, read<typename Law::Constants>(constants),
                       read<typename Law::Memory>(memory));
  }

  /// What a new spring keeps.
  static void start(const double* constants, const SpringIdentity& spring,
                    double* memory) requires LawWithStart<Law> {
    const typename Law::Memory begun = Law::start(read<typename Law::Constants>(constants), spring);
    std::memcpy(memory, &begun, own * sizeof(double));
  }

  /// `constants`: those of the law; `memory`: memory_of<Law>() numbers, as they were and then as
  /// they are.
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
