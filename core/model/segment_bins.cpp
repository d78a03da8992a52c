#include <model/segment_bins.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

SegmentBins::SegmentBins(const Body& body, std::span<const Segment> segments) : body_(body) {
  for (const Segment& of : segments)
    longest_ = std::max(longest_, norm(body.position(of.b) - body.position(of.a)));
  edge_ = 2 * std::max(longest_, body.grid.spacing);
  const Vec3 size = body.highest - body.lowest;
  constexpr double most_bins_along_an_axis = 500;
  for (int axis = 0; axis < 3; ++axis)
    edge_ = std::max(edge_, size[axis] / most_bins_along_an_axis);
  for (std::size_t axis = 0; axis < 3; ++axis)
    counts_[axis] = static_cast<std::size_t>(size[axis] / edge_) + 1;
  first_.assign(counts_[0] * counts_[1] * counts_[2] + 1, 0);
  std::vector<std::size_t> bin(segments.size());
  for (std::size_t n = 0; n < segments.size(); ++n) {
    bin[n] = index(bin_of(middle(segments[n])));
    ++first_[bin[n] + 1];
  }
  for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
  sorted_.resize(segments.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t n = 0; n < segments.size(); ++n) sorted_[next[bin[n]]++] = n;
}

std::array<std::size_t, 3> SegmentBins::bin_of(Vec3 point) const {
  std::array<std::size_t, 3> bin{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double steps = (point[axis] - body_.lowest[axis]) / edge_;
    bin[axis] =
        static_cast<std::size_t>(std::clamp(steps, 0.0, static_cast<double>(counts_[axis] - 1)));
  }
  return bin;
}

}  // namespace hyperlattice
