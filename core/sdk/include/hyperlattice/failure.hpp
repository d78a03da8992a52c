// A failure criterion of springs: the rule that says whether a base spring breaks. It states an
// alarm, the elongation below which the spring cannot break; fast kernels only compare with it. The
// criterion decides about springs above their alarm, which it gets in batches. It may keep a few
// numbers for each spring, such as a damage that grows with time:
//
//   struct Memory { double damage = 0; };
//   bool breaks(const SpringFacts& spring, const AlarmedSpring& state, Memory& memory) const;
//
// The other kind of failure component is a strength surface (strength_surface.hpp).
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/law.hpp>
#include <hyperlattice/strength_surface.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace hyperlattice {

/// Facts about a class of base springs.
struct SpringFacts {
  double rest_length = 0;  ///< metres
  double stiffness = 0;    ///< N/m
  double spacing = 0;      ///< lattice constant, metres
  std::uint32_t spring_class = 0;
  /// Base springs that cross a unit area inside the body, 1/m2, mean over all directions of the
  /// area.
  double crossings = 0;
};

/// How many numbers a criterion may keep for each spring.
inline constexpr std::size_t max_failure_memory = 6;

/// One base spring, for criteria that need its identity, its rate or the time.
struct AlarmedSpring {
  double time = 0;        ///< seconds
  double elongation = 0;  ///< metres
  /// Ends, a < b; the same in every run of a scene, for any number of threads.
  Particle a = 0, b = 0;
  /// Rate of elongation, half a step before `time`, m/s; 0 if the criterion does not ask for it.
  double rate = 0;
  /// Length of the last step, s; 0 at the start, and where the last step did not advance the time.
  double time_step = 0;
};

/// Base springs above their alarm, at one time.
struct SpringBatch {
  double time = 0;                     ///< seconds
  SpringFacts spring;                  ///< facts that hold for all springs of the batch
  std::span<const double> elongation;  ///< metres
  /// Ends of the springs; empty if the criterion does not ask for them.
  std::span<const Particle> a, b;
  std::span<const double> rate;  ///< rate of elongation, m/s; empty likewise
  /// [spring][number] memory of the criterion, in: after the last review of the spring, out: after
  /// this one. Null if the criterion has none.
  double* memory = nullptr;
  double time_step = 0;  ///< see AlarmedSpring, seconds
};

/// Functions of a failure component across the boundary. A criterion of springs has alarm and
/// review, a strength surface has the functions of `surface` only.
struct FailureFunctions {
  bool (*alarm)(const void* failure, const SpringFacts& spring, double& elongation,
                const Complaint& why) noexcept;
  bool (*review)(const void* failure, const SpringBatch& batch, std::uint8_t* broken,
                 const Complaint& why) noexcept;
  bool asks_ends, asks_rate;  ///< review needs SpringBatch::a and b; SpringBatch::rate
  std::uint32_t memory;       ///< how many numbers the criterion keeps for each spring
  /// Writes the memory of a spring that no review has seen yet. Null if there is no memory.
  void (*start)(double* memory) noexcept;
  SurfaceFunctions surface;
};

/// The criterion needs only the elongation of a spring, m.
template <class T>
concept AsksElongation = requires(const T& failure, const SpringFacts& spring) {
  { failure.breaks(spring, 0.0) } -> std::convertible_to<bool>;
};
/// The criterion needs the state of a spring: ends, rate, time.
template <class T>
concept AsksState = requires(const T& failure, const SpringFacts& spring,
                             const AlarmedSpring& state) {
  { failure.breaks(spring, state) } -> std::convertible_to<bool>;
};

/// The criterion keeps numbers for each spring.
template <class T>
concept AsksMemory = requires(const T& failure, const SpringFacts& spring,
                              const AlarmedSpring& state, typename T::Memory& memory) {
  { failure.breaks(spring, state, memory) } -> std::convertible_to<bool>;
};

/// A failure class has: double alarm(const SpringFacts&) const, in m; and one of
///
///   bool breaks(const SpringFacts&, double elongation) const;
///   bool breaks(const SpringFacts&, const AlarmedSpring&) const;
///   bool breaks(const SpringFacts&, const AlarmedSpring&, Memory&) const;
///
/// A run calls breaks once a step for each spring above the alarm, and for no other spring. Below
/// the alarm, where only the contract's test asks, it must say no. An exception ends the run. A
/// criterion that needs the rate has static constexpr bool asks_rate = true.
///
/// Memory is a struct of the class with at most max_failure_memory doubles and nothing else. The
/// initializers of its members are the values with which each spring starts; without one, a number
/// starts at 0. Each spring has its own Memory, kept from step to step and in checkpoints; a spring
/// between two materials has one for each of their criteria. A spring below the alarm keeps its
/// memory unchanged. `time` and `time_step` show whether the spring was above the alarm one step
/// earlier: the criterion may keep the time at which it was asked last.
template <class T>
concept FailureComponent = requires(const T& failure, const SpringFacts& spring) {
  { failure.alarm(spring) } -> std::convertible_to<double>;
  requires AsksElongation<T> || AsksState<T> || AsksMemory<T>;
};

namespace detail {
template <FailureComponent T>
constexpr bool asks_rate() {
  if constexpr (requires { T::asks_rate; })
    return T::asks_rate;
  else
    return false;
}

template <FailureComponent T>
AlarmedSpring state_in(const SpringBatch& batch, std::size_t n) {
  return {batch.time,
          batch.elongation[n],
          batch.a[n],
          batch.b[n],
          asks_rate<T>() ? batch.rate[n] : 0,
          batch.time_step};
}

/// Returns how many numbers a criterion keeps for each spring.
template <FailureComponent T>
constexpr std::uint32_t failure_memory() {
  if constexpr (AsksMemory<T>) {
    constexpr std::size_t numbers = numbers_in<typename T::Memory>();
    static_assert(numbers > 0 && numbers <= max_failure_memory);
    return numbers;
  } else {
    return 0;
  }
}

/// The numbers of a criterion's Memory.
template <FailureComponent T>
using FailureNumbers = std::array<double, failure_memory<T>()>;

template <FailureComponent T>
bool breaks(const T& failure, const SpringBatch& batch, std::size_t n) {
  if constexpr (AsksMemory<T>) {
    FailureNumbers<T> numbers;
    double* const kept = batch.memory + n * numbers.size();
    std::copy_n(kept, numbers.size(), numbers.begin());
    auto memory = std::bit_cast<typename T::Memory>(numbers);
    const bool broken = failure.breaks(batch.spring, state_in<T>(batch, n), memory);
    numbers = std::bit_cast<FailureNumbers<T>>(memory);
    std::copy_n(numbers.begin(), numbers.size(), kept);
    return broken;
  } else if constexpr (AsksElongation<T>) {
    return failure.breaks(batch.spring, batch.elongation[n]);
  } else {
    return failure.breaks(batch.spring, state_in<T>(batch, n));
  }
}

template <FailureComponent T>
constexpr auto start_of() {
  void (*start)(double*) noexcept = nullptr;
  if constexpr (failure_memory<T>() > 0)
    start = [](double* memory) noexcept {
      const auto numbers = std::bit_cast<FailureNumbers<T>>(typename T::Memory{});
      std::copy_n(numbers.begin(), numbers.size(), memory);
    };
  return start;
}

template <FailureComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::failures;
  static constexpr FailureFunctions table{
      [](const void* failure, const SpringFacts& spring, double& elongation,
         const Complaint& why) noexcept {
        return guarded(why, [&] { elongation = static_cast<const T*>(failure)->alarm(spring); });
      },
      [](const void* failure, const SpringBatch& batch, std::uint8_t* broken,
         const Complaint& why) noexcept {
        return guarded(why, [&] {
          for (std::size_t n = 0; n < batch.elongation.size(); ++n)
            broken[n] = breaks(*static_cast<const T*>(failure), batch, n) ? 1 : 0;
        });
      },
      !AsksElongation<T>,
      asks_rate<T>(),
      failure_memory<T>(),
      start_of<T>(),
      {nullptr, nullptr}};
};

template <SurfaceComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::failures;
  static constexpr FailureFunctions table{
      nullptr,
      nullptr,
      false,
      false,
      0,
      nullptr,
      {[](const void* held, CohesiveInputs& inputs) noexcept {
         inputs = static_cast<const WithInputs<T>*>(held)->inputs;
       },
       [](const void* held, std::span<const PrincipalStress> stresses, double* ratios,
          const Complaint& why) noexcept {
         return guarded(why, [&] {
           const T& surface = static_cast<const WithInputs<T>*>(held)->surface;
           for (std::size_t n = 0; n < stresses.size(); ++n) ratios[n] = surface.ratio(stresses[n]);
         });
       }}};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
