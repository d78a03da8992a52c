// A failure criterion that decides about all springs at once. The core asks it once for each state,
// with arrays of all springs above its alarm. It costs a pass over all springs in every step; other
// criteria (failure.hpp) are asked beside the forces and cost far less. It is for criteria that
// compare springs with each other, and for those that run in another language.
#pragma once

#include <hyperlattice/failure.hpp>

#include <vector>

namespace hyperlattice {

/// Base springs above the alarm of a criterion, in one state. Each array has an entry for each
/// spring. Every spring comes once. The order is the same in every run of a scene, for any number
/// of threads.
struct SpringArrays {
  double time = 0;                                  ///< seconds
  double time_step = 0;                             ///< see AlarmedSpring, seconds
  std::span<const double> elongation, rest_length;  ///< metres
  std::span<const double> stiffness;                ///< N/m
  std::span<const double> rate;                     ///< see AlarmedSpring, m/s
  std::span<const std::uint32_t> spring_class;
  std::span<const Particle> a, b;  ///< ends, a < b
};

/// Functions of such a criterion across the boundary. `springs` are those of any criterion.
struct ArrayFailureFunctions {
  FailureFunctions springs;
  bool (*breaks)(const void* failure, const SpringArrays& springs, std::uint8_t* broken,
                 const Complaint& why) noexcept;
};

/// A failure class of this kind has: double alarm(const SpringFacts&) const, in m; and
///
///   void breaks(const SpringArrays& springs, std::span<std::uint8_t> broken) const;
///
/// which sets broken[n] to 1 if the spring n breaks; all are 0 before. A run calls it in one
/// thread, once in each explicit step, at the step's start. Solvers for states of rest and implicit
/// steps call it several times for a state, with smaller elongations. An exception ends the run.
/// The criterion has no memory.
template <class T>
concept ArrayFailureComponent = requires(const T& failure, const SpringFacts& spring,
                                         const SpringArrays& springs,
                                         std::span<std::uint8_t> broken) {
  { failure.alarm(spring) } -> std::convertible_to<double>;
  failure.breaks(springs, broken);
};

namespace detail {
/// Asks the criterion about the springs of a batch alone, as the tests of a plugin do.
template <ArrayFailureComponent T>
void review_batch(const T& failure, const SpringBatch& batch, std::uint8_t* broken) {
  const std::size_t size = batch.elongation.size();
  const std::vector<double> rest_length(size, batch.spring.rest_length),
      stiffness(size, batch.spring.stiffness);
  const std::vector<std::uint32_t> spring_class(size, batch.spring.spring_class);
  std::fill_n(broken, size, std::uint8_t{0});
  failure.breaks({batch.time, batch.time_step, batch.elongation, rest_length, stiffness, batch.rate,
                  spring_class, batch.a, batch.b},
                 {broken, size});
}

template <ArrayFailureComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::failures;
  static constexpr ArrayFailureFunctions table{
      {[](const void* failure, const SpringFacts& spring, double& elongation,
          const Complaint& why) noexcept {
         return guarded(why, [&] { elongation = static_cast<const T*>(failure)->alarm(spring); });
       },
       [](const void* failure, const SpringBatch& batch, std::uint8_t* broken,
          const Complaint& why) noexcept {
         return guarded(why, [&] { review_batch(*static_cast<const T*>(failure), batch, broken); });
       },
       true,
       true,
       0,
       nullptr,
       {nullptr, nullptr}},
      [](const void* failure, const SpringArrays& springs, std::uint8_t* broken,
         const Complaint& why) noexcept {
        return guarded(why, [&] {
          static_cast<const T*>(failure)->breaks(springs, {broken, springs.elongation.size()});
        });
      }};
};
}  // namespace detail
}  // namespace hyperlattice
