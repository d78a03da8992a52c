// A law: the force (N) and the energy (J) of one spring from its elongation. The kernels that apply
// a law to a lattice come from kernels/. Constants, memory and tangent are optional, each
// independent of the others.
//
// 1. Without memory. Templates, which take numbers as well as vectors of numbers:
//
//      struct Cubic {
//        template <class Real> static Real force(Real stiffness, Real elongation);
//        template <class Real> static Real energy(Real stiffness, Real elongation);
//        // Only if the force is proportional to the elongation:
//        static constexpr bool linear = true;
//      };
//
//    With constants, which the material sets in MaterialConstants::law:
//
//      struct Stiffening {
//        struct Constants { double strain; };  // doubles only
//        template <class Real> static Real force(const SpringOf<Real>& s, const Constants& c);
//        template <class Real> static Real energy(const SpringOf<Real>& s, const Constants& c);
//      };
//
// 2. With a memory: numbers that each spring keeps from step to step. Ordinary code on doubles, if
//    and else included:
//
//      struct Slider {
//        struct Constants { double limit; };
//        struct Memory { double slipped = 0; };  // doubles only; zeros if there is no start()
//        // Only for springs whose memory does not start at zero.
//        static Memory start(const Constants& c, const SpringIdentity& spring);
//        // Called once a step, before force().
//        static void update(const SpringState& s, const Constants& c, Memory& m);
//        // N, positive if the spring pulls.
//        static double force(const SpringState& s, const Constants& c, const Memory& m);
//        // Recoverable energy, J.
//        static double energy(const SpringState& s, const Constants& c, const Memory& m);
//        // Only for laws that soften: 1 intact, 0 gone. Their dissipation is energy of fracture.
//        static double integrity(const SpringState& s, const Constants& c, const Memory& m);
//      };
//
//    Such a law may give fields, numbers of a spring that outputs show. A particle has the mean
//    over its base springs of the law, each by its share. The material's schema names them, in the
//    same order: .field("slipped", "m", "amount of slip").
//
//        struct Fields { double slipped; };  // doubles only
//        static Fields fields(const SpringState& s, const Constants& c, const Memory& m);
//
//    A law without constants leaves out the argument `c`. The core computes the dissipated energy:
//    the work of the force less the change of the energy.
//
// Each law may have tangent(), with the arguments of its force(): the derivative of the force with
// respect to the elongation, N/m. With a memory, `m` is the memory at the start of the load step.
// Without it static solvers take a central difference of the force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace hyperlattice {

/// A spring at one instant, for a law with constants and without memory. Real: a number or a vector
/// of numbers.
template <class Real>
struct SpringOf {
  Real stiffness, rest_length, elongation;  ///< N/m, m, m
};

/// A spring at one instant, for a law with a memory.
struct SpringState {
  double stiffness = 0;    ///< N/m
  double rest_length = 0;  ///< m
  double elongation = 0;   ///< m
  double rate = 0;         ///< rate of the elongation over the last step, m/s; 0 at the start
  double time_step = 0;    ///< length of the last step, s; 0 at the start and in a static solver
};

/// The particles at the ends of a base spring, a < b, numbered as the lattice names them. A cross
/// spring has the identity of its base spring.
struct SpringIdentity {
  std::uint64_t a = 0, b = 0;
};

inline constexpr std::size_t max_law_constants = 8, max_law_memory = 6, max_law_fields = 6;

/// The law has constants, which its material sets for each class of springs.
template <class Law>
concept LawWithConstants = requires {
  typename Law::Constants;
};
/// The law keeps numbers for each spring.
template <class Law>
concept LawWithMemory = requires {
  typename Law::Memory;
};

namespace detail {
struct NoConstants {};
template <class Law>
struct ConstantsOf {
  using Type = NoConstants;
};
template <LawWithConstants Law>
struct ConstantsOf<Law> {
  using Type = typename Law::Constants;
};
}  // namespace detail

/// Returns how many doubles a struct of doubles holds.
template <class Struct>
constexpr std::size_t numbers_in() {
  if constexpr (std::is_empty_v<Struct>) return 0;
  static_assert(std::is_empty_v<Struct> || sizeof(Struct) % sizeof(double) == 0, "doubles only");
  return sizeof(Struct) / sizeof(double);
}

/// Returns the struct that these numbers hold.
template <class Struct>
Struct struct_of(const double* numbers) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  Struct read;
  if constexpr (numbers_in<Struct>() > 0) std::memcpy(&read, numbers, sizeof read);
  return read;
}

/// The law's constants, in the order of the calls of its functions.
template <class Law>
class ConstantsOfLaw {
 public:
  /// `numbers`: the constants; not used if the law has none.
  explicit ConstantsOfLaw(const double* numbers)
      : constants_(struct_of<typename detail::ConstantsOf<Law>::Type>(numbers)) {
    static_assert(numbers_in<typename detail::ConstantsOf<Law>::Type>() <= max_law_constants);
  }
  /// Calls `function` with the spring, the constants if the law has some, and the memory if given.
  template <class Function, class Spring, class... Memory>
  decltype(auto) call(const Function& function, const Spring& spring, Memory&&... memory) const {
    if constexpr (LawWithConstants<Law>)
      return function(spring, constants_, static_cast<Memory&&>(memory)...);
    else
      return function(spring, static_cast<Memory&&>(memory)...);
  }
  const auto& constants() const { return constants_; }

 private:
  typename detail::ConstantsOf<Law>::Type constants_;
};

// Functions of a law without memory, for numbers and for vectors of numbers.

/// Returns the force, N. `constants`: see ConstantsOfLaw.
template <class Law, class Real>
Real force_of(const SpringOf<Real>& spring, const double* constants) {
  if constexpr (LawWithConstants<Law>)
    return Law::force(spring, struct_of<typename Law::Constants>(constants));
  else
    return Law::force(spring.stiffness, spring.elongation);
}
/// Returns the energy, J.
template <class Law, class Real>
Real energy_of(const SpringOf<Real>& spring, const double* constants) {
  if constexpr (LawWithConstants<Law>)
    return Law::energy(spring, struct_of<typename Law::Constants>(constants));
  else
    return Law::energy(spring.stiffness, spring.elongation);
}

/// Whether a law has `static constexpr bool linear = true`: its force is proportional to the
/// elongation, which saves arithmetic, and two half springs in series are one such spring.
template <class Law>
constexpr bool is_linear = requires {
  requires Law::linear;
};
/// Whether a law has an integrity: it softens.
template <class Law>
constexpr bool has_integrity = requires {
  &Law::integrity;
};
template <class Law>
constexpr bool has_start = requires {
  &Law::start;
};

/// Returns how many fields a law gives.
template <class Law>
constexpr std::size_t field_count() {
  if constexpr (LawWithMemory<Law> && requires { typename Law::Fields; }) {
    static_assert(numbers_in<typename Law::Fields>() <= max_law_fields);
    return numbers_in<typename Law::Fields>();
  } else {
    return 0;
  }
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

/// Result of one step of a spring.
struct SpringStep {
  double force = 0;       ///< N
  double energy = 0;      ///< J
  double dissipated = 0;  ///< J, during the last step
  double integrity = 1;   ///< 1 intact, 0 gone
  bool gone = false;      ///< whether the integrity became 0 in this step
};

/// One spring of a law with a memory.
template <LawWithMemory Law>
class SpringWithMemory {
  using Memory = typename Law::Memory;
  static constexpr std::size_t own = numbers_in<Memory>();

 public:
  explicit SpringWithMemory(const double* constants) : law_(constants) {}

  /// Sets the memory of a new spring, whose numbers are all zero.
  void start(const SpringIdentity& spring, double* memory) const {
    if constexpr (has_start<Law>) {
      const Memory begun = [&] {
        if constexpr (LawWithConstants<Law>)
          return Law::start(law_.constants(), spring);
        else
          return Law::start(spring);
      }();
      std::memcpy(memory, &begun, sizeof begun);
    }
  }

  /// Advances the spring by one step. `memory`: memory_of<Law>() numbers, in: values at the
  /// previous step, out: values at the current step.
  SpringStep take(SpringState state, double* memory) const {
    auto kept = struct_of<Memory>(memory);
    double& last_elongation = memory[own];
    double& last_force = memory[own + 1];
    SpringState before = state;
    before.elongation = last_elongation;
    const double energy_before = energy(before, kept), integrity_before = integrity(before, kept),
                 stretched = state.elongation - last_elongation;
    state.rate = state.time_step > 0 ? stretched / state.time_step : 0;
    SpringStep step;
    step.force = force_after_update(state, kept);
    step.energy = energy(state, kept);
    step.dissipated = 0.5 * (last_force + step.force) * stretched - (step.energy - energy_before);
    step.integrity = integrity(state, kept);
    step.gone = step.integrity <= 0 && integrity_before > 0;
    if constexpr (own > 0) std::memcpy(memory, &kept, sizeof kept);
    last_elongation = state.elongation;
    last_force = step.force;
    return step;
  }

  /// Returns the present force, energy and integrity for the present memory.
  SpringStep present(const SpringState& state, const double* memory) const {
    const auto kept = struct_of<Memory>(memory);
    SpringStep step;
    step.force = memory[own + 1];
    step.energy = energy(state, kept);
    step.integrity = integrity(state, kept);
    return step;
  }

  /// Writes the spring's fields, field_count<Law>() numbers.
  void read_fields(const SpringState& state, const double* memory, double* values) const {
    const typename Law::Fields fields = law_.call(
        [](const auto&... all) { return Law::fields(all...); }, state, struct_of<Memory>(memory));
    std::memcpy(values, &fields, sizeof fields);
  }

  /// Returns the derivative, N/m, of the force after a step of state.time_step seconds, 0 in
  /// statics, that starts from `memory`.
  double tangent(const SpringState& state, const double* memory) const {
    const auto kept = struct_of<Memory>(memory);
    if constexpr (requires { &Law::tangent; }) {
      return law_.call([](const auto&... all) { return Law::tangent(all...); }, state, kept);
    } else {
      const double h = 1e-7 * state.rest_length;
      const auto force = [&](double elongation) {
        Memory trial = kept;
        SpringState at = state;
        at.elongation = elongation;
        if (at.time_step > 0) at.rate = (elongation - memory[own]) / at.time_step;
        return force_after_update(at, trial);
      };
      return (force(state.elongation + h) - force(state.elongation - h)) / (2 * h);
    }
  }

 private:
  double force_after_update(const SpringState& state, Memory& memory) const {
    law_.call([](auto&&... all) { Law::update(all...); }, state, memory);
    return law_.call([](const auto&... all) { return Law::force(all...); }, state, memory);
  }
  double energy(const SpringState& state, const Memory& memory) const {
    return law_.call([](const auto&... all) { return Law::energy(all...); }, state, memory);
  }
  double integrity(const SpringState& state, const Memory& memory) const {
    if constexpr (has_integrity<Law>)
      return law_.call([](const auto&... all) { return Law::integrity(all...); }, state, memory);
    return 1;
  }

  ConstantsOfLaw<Law> law_;
};

}  // namespace hyperlattice
