// Lines between particles, sorted into the cells of a coarse grid by their middles: finds those
// that may pass through a box.
#pragma once

#include <model/body.hpp>
#include <model/cut_springs.hpp>

#include <array>

namespace hyperlattice {

class SegmentBins {
 public:
  /// `body` and `segments` must outlive the object.
  SegmentBins(const Body& body, std::span<const Segment> segments);

  /// Returns the length of the longest line, m.
  double longest() const { return longest_; }
  /// Calls visit(index) for each line that may have a point in the box between the corners, m.
  template <class Visit>
  void for_near(Vec3 low, Vec3 high, const Visit& visit) const {
    const Vec3 half = 0.5 * longest_ * Vec3{1, 1, 1};
    const std::array<std::size_t, 3> first = bin_of(low - half), last = bin_of(high + half);
    for (std::size_t k = first[2]; k <= last[2]; ++k)
      for (std::size_t j = first[1]; j <= last[1]; ++j)
        for (std::size_t at = first_[index({first[0], j, k})],
                         end = first_[index({last[0], j, k}) + 1];
             at < end; ++at)
          visit(sorted_[at]);
  }

 private:
  Vec3 middle(const Segment& of) const {
    return 0.5 * (body_.position(of.a) + body_.position(of.b));
  }
  std::array<std::size_t, 3> bin_of(Vec3 point) const;  ///< the nearest bin
  std::size_t index(const std::array<std::size_t, 3>& bin) const {
    return (bin[2] * counts_[1] + bin[1]) * counts_[0] + bin[0];
  }

  const Body& body_;
  double longest_ = 0, edge_ = 1;
  std::array<std::size_t, 3> counts_{1, 1, 1};
  std::vector<std::size_t> first_;  ///< first entry of each bin in sorted_; one more at the end
  std::vector<std::size_t> sorted_;
};

}  // namespace hyperlattice
