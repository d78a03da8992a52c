// The observed order of convergence p: error ~ size^p, where the size is a spacing or a time step.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hyperlattice::study {

/// The error of a run with its size.
struct SizedError {
  double size = 0;   ///< value of the refinement axis (spacing, time step), above 0
  double error = 0;  ///< above 0
};

/// The largest order that is believed. The method has order 2 at most; an order above 3 is not
/// scatter around 2: the sizes are too coarse to show an order, or errors cancel.
inline constexpr double greatest_order = 3;

/// An observed order of convergence.
struct ObservedOrder {
  double order = 0;  ///< slope of log error against log size, by least squares
  /// The order between neighbouring sizes, from the coarsest to the finest; one less than errors.
  std::vector<double> pairs;
  std::vector<SizedError> errors;  ///< from the coarsest to the finest
  /// A sentence: why the order does not hold for finer sizes; empty if it may hold.
  std::string doubt;
};

/// Returns the observed order, without errors of zero and repeated sizes; nothing if fewer than two
/// errors are left.
std::optional<ObservedOrder> observed_order(std::vector<SizedError> errors);

/// Returns the size at which the error meets `target`, by a power law through the finest error;
/// nothing if the error does not fall with the size, or if the order is in doubt.
std::optional<double> size_for(const ObservedOrder& order, double target);

}  // namespace hyperlattice::study
