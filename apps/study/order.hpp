// The observed order of convergence: with which power of the size (spacing, time step) the error
// falls.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hyperlattice::study {

struct SizedError {
  double size = 0;   ///< of the refinement, above 0
  double error = 0;  ///< above 0
};

/// The method is of second order at most. An order above this one is no mere scatter around 2: the
/// sizes are too coarse to show any, or errors cancel.
inline constexpr double greatest_order = 3;

struct ObservedOrder {
  double order = 0;  ///< slope of log error against log size, by least squares
  std::vector<double>
      pairs;  ///< the same between neighbours, from the coarsest on; one less than there are errors
  std::vector<SizedError> errors;  ///< from the coarsest on
  std::string doubt;  ///< why it says nothing of finer sizes, a sentence; empty: it may
};

/// Errors that are zero and sizes that come twice are left out; nothing with fewer than two left.
std::optional<ObservedOrder> observed_order(std::vector<SizedError> errors);

/// The size at which an error falls to a target, by a power law through the finest error; nothing
/// if it does not fall with the size, or if the order is in doubt.
std::optional<double> size_for(const ObservedOrder& order, double target);

}  // namespace hyperlattice::study
