// A failure criterion: when a base spring breaks. It states an alarm, the elongation below which nothing can happen; fast kernels only
// compare with it. Springs above their alarm are reviewed in batches, where the criterion decides.
#pragma once

#include <hyperlattice/component.hpp>

namespace hyperlattice {

/// What a criterion knows of a class of base springs.
struct SpringFacts {
  double rest_length = 0;  ///< metres
  double stiffness = 0;    ///< N/m
  double spacing = 0;      ///< lattice constant, metres
  std::uint32_t spring_class = 0;
};

/// Base springs above their alarm, at one time.
struct SpringBatch {
  double time = 0;                     ///< seconds
  SpringFacts spring;                  ///< the same for all of the batch
  std::span<const double> elongation;  ///< metres
};

struct FailureFunctions {
  double (*alarm)(const void* failure, const SpringFacts& spring) noexcept;
  void (*review)(const void* failure, const SpringBatch& batch, std::uint8_t* broken) noexcept;
};

/// A failure class has: double alarm(const SpringFacts&) const, in metres; and
/// bool breaks(const SpringFacts&, double elongation) const, asked for springs above the alarm only. Both must not throw.
template <class T>
concept FailureComponent = requires(const T& failure, const SpringFacts& spring) {
  { failure.alarm(spring) } -> std::convertible_to<double>;
  { failure.breaks(spring, 0.0) } -> std::convertible_to<bool>;
};

namespace detail {
template <FailureComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::failures;
  static constexpr FailureFunctions table{
      [](const void* failure, const SpringFacts& spring) noexcept { return static_cast<double>(static_cast<const T*>(failure)->alarm(spring)); },
      [](const void* failure, const SpringBatch& batch, std::uint8_t* broken) noexcept {
        for (std::size_t n = 0; n < batch.elongation.size(); ++n)
          broken[n] = static_cast<const T*>(failure)->breaks(batch.spring, batch.elongation[n]) ? 1 : 0;
      }};
};
}  // namespace detail
}  // namespace hyperlattice
