// A failure criterion: the rule that says whether a base spring breaks. It states an alarm, the
// elongation below which the spring cannot break; fast kernels only compare with it. The criterion
// decides about springs above their alarm, which it gets in batches.
#pragma once

#include <hyperlattice/component.hpp>

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

/// One base spring, for criteria that need its identity or rate.
struct AlarmedSpring {
  double time = 0;        ///< seconds
  double elongation = 0;  ///< metres
  /// Ends, a < b; the same in every run of a scene, for any number of threads.
  Particle a = 0, b = 0;
  /// Rate of elongation, half a step before `time`, m/s; 0 if the criterion does not ask for it.
  double rate = 0;
};

/// Base springs above their alarm, at one time.
struct SpringBatch {
  double time = 0;                     ///< seconds
  SpringFacts spring;                  ///< facts that hold for all springs of the batch
  std::span<const double> elongation;  ///< metres
  /// Ends of the springs; empty if the criterion does not ask for them.
  std::span<const Particle> a, b;
  std::span<const double> rate;  ///< rate of elongation, m/s; empty likewise
};

/// Functions of a failure criterion across the boundary.
struct FailureFunctions {
  bool (*alarm)(const void* failure, const SpringFacts& spring, double& elongation,
                const Complaint& why) noexcept;
  bool (*review)(const void* failure, const SpringBatch& batch, std::uint8_t* broken,
                 const Complaint& why) noexcept;
  bool asks_ends, asks_rate;  ///< review needs SpringBatch::a and b; SpringBatch::rate
};

template <class T>
concept AsksElongation = requires(const T& failure, const SpringFacts& spring) {
  { failure.breaks(spring, 0.0) } -> std::convertible_to<bool>;
};
template <class T>
concept AsksState = requires(const T& failure, const SpringFacts& spring,
                             const AlarmedSpring& state) {
  { failure.breaks(spring, state) } -> std::convertible_to<bool>;
};

/// A failure class has: double alarm(const SpringFacts&) const, in m; and bool breaks(const
/// SpringFacts&, double elongation) const, or with an AlarmedSpring instead of the elongation if it
/// needs the identity of the spring. breaks is called only for springs above the alarm. An
/// exception from either ends the run. A criterion that needs the rate has static constexpr bool
/// asks_rate = true; only structured lattices provide the rate.
template <class T>
concept FailureComponent = requires(const T& failure, const SpringFacts& spring) {
  { failure.alarm(spring) } -> std::convertible_to<double>;
  requires AsksElongation<T> || AsksState<T>;
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
  return {batch.time, batch.elongation[n], batch.a[n], batch.b[n],
          asks_rate<T>() ? batch.rate[n] : 0};
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
            if constexpr (AsksElongation<T>)
              broken[n] =
                  static_cast<const T*>(failure)->breaks(batch.spring, batch.elongation[n]) ? 1 : 0;
            else
              broken[n] =
                  static_cast<const T*>(failure)->breaks(batch.spring, state_in<T>(batch, n)) ? 1
                                                                                              : 0;
        });
      },
      !AsksElongation<T>, asks_rate<T>()};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
