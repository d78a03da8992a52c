// Reduces a long curve to the points that a picture needs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hyperlattice::report {

/// Returns ascending indices of points that draw the same picture as all points. Divides x into
/// `columns` equal parts and keeps the first, least, greatest and last point of each part, so that
/// peaks stay, and a point that is not a number where the curve has a gap. Returns all points if
/// they are few, or if x decreases or is not finite.
std::vector<std::size_t> thinned(std::span<const double> x, std::span<const double> y,
                                 std::size_t columns);

}  // namespace hyperlattice::report
