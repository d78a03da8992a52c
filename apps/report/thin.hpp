// Which points of a long curve a picture needs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hyperlattice::report {

/// Indices, ascending, of the points that draw the same picture as all of them: the first, least,
/// greatest and last of each of `columns` equal parts of x, so that peaks stay, and a point that is
/// no number where the curve has a gap. All points if they are few, or if x falls or is not finite
/// somewhere.
std::vector<std::size_t> thinned(std::span<const double> x, std::span<const double> y,
                                 std::size_t columns);

}  // namespace hyperlattice::report
