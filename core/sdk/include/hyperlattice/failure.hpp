// A failure criterion: when a base spring breaks. It states an alarm, the elongation below which
// nothing can happen; fast kernels only compare with it. Springs above their alarm are reviewed in
// batches, where the criterion decides.
#pragma once

#include <hyperlattice/component.hpp>

namespace hyperlattice {

/// What a criterion knows of a class of base springs.
struct SpringFacts {
  double rest_length = 0;  ///< metres
  double stiffness = 0;    ///< N/m
  double spacing = 0;      ///< lattice constant, metres
  std::uint32_t spring_class = 0;
  double crossings = 0;  ///< base springs that pass through a unit of area inside the body, the
                         ///< mean of all its directions, 1/m2
};

/// One base spring, for criteria that ask which it is.
struct AlarmedSpring {
  double time = 0;        ///< seconds
  double elongation = 0;  ///< metres
  Particle a = 0,
           b = 0;  ///< its ends, a < b: the same in every run of a scene, whatever its threads
  double rate =
      0;  ///< of elongation, half a step before, m/s; 0 if the criterion does not ask for it
};

/// Base springs above their alarm, at one time.
struct SpringBatch {
  double time = 0;                     ///< seconds
  SpringFacts spring;                  ///< the same for all of the batch
  std::span<const double> elongation;  ///< metres
  std::span<const Particle> a, b;      ///< their ends; empty if the criterion does not ask for them
  std::span<const double> rate;        ///< of elongation, m/s; likewise
};

struct FailureFunctions {
  bool (*alarm)(const void* failure, const SpringFacts& spring, double& elongation,
                const Complaint& why) noexcept;
  bool (*review)(const void* failure, const SpringBatch& batch, std::uint8_t* broken,
                 const Complaint& why) noexcept;
  bool asks_ends, asks_rate;  ///< review wants SpringBatch::a and b, rate
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

/// A failure class has: double alarm(const SpringFacts&) const, in metres; and
/// bool breaks(const SpringFacts&, double elongation) const, or with an AlarmedSpring in place of
/// the elongation if it must know which spring it is; asked for springs above the alarm only. What
/// either throws ends the run. A criterion that needs the state's rate says static constexpr bool
/// asks_rate = true; it is for structured lattices.
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

#include <hyperlattice/boundary.hpp>  // the gate, once all that a family hands over is known
