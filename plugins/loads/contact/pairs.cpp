#include "pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyperlattice::contact {

namespace {

/// A cube of space with the edge reach + margin; cubes are ordered by z, y, x.
struct Cell {
  std::int64_t z = 0, y = 0, x = 0;
  auto operator<=>(const Cell&) const = default;
};
struct Member {
  Cell cell;
  std::uint32_t point = 0;
  auto operator<=>(const Member&) const = default;
};

/// Returns the cube of edge `width`, m, that holds a position. Positions that are not finite, or
/// further than 1e15 cubes away, go to the origin's cube; the run's guard stops such runs.
Cell cell_of(Vec3 at, double width) {
  const auto count = [&](double value) {
    constexpr double most = 1e15;
    const double cells = std::floor(value / width);
    return std::abs(cells) < most ? static_cast<std::int64_t>(cells) : std::int64_t{0};
  };
  return {count(at.z), count(at.y), count(at.x)};
}

}  // namespace

bool Pairs::have_moved(std::span<const Vec3> displacement) const {
  const double allowed = 0.5 * margin * reach_, square = allowed * allowed;
  for (std::size_t n = 0; n < displacement.size(); ++n) {
    const Vec3 moved = displacement[n] - found_at_[n];
    if (!(dot(moved, moved) <= square)) return true;
  }
  return false;
}

void Pairs::find(std::span<const Vec3> displacement) {
  if (!found_at_.empty() && !have_moved(displacement)) return;
  found_at_.assign(displacement.begin(), displacement.end());
  const double width = (1 + margin) * reach_;
  std::vector<Member> members;
  for (std::uint32_t n = 0; n < at_rest_.size(); ++n)
    members.push_back({cell_of(at_rest_[n] + displacement[n], width), n});
  std::sort(members.begin(), members.end());
  first_.assign(1, 0);
  other_.clear();
  for (std::size_t n = 0; n < at_rest_.size(); ++n) {
    const Cell here = cell_of(at_rest_[n] + displacement[n], width);
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {  // three cells along x are consecutive
        const Cell from{here.z + dz, here.y + dy, here.x - 1},
            to{here.z + dz, here.y + dy, here.x + 1};
        for (auto m = std::lower_bound(members.begin(), members.end(), Member{from, 0});
             m != members.end() && m->cell <= to; ++m) {
          const Vec3 way = apart(n, m->point, displacement);
          if (m->point != n && dot(way, way) < width * width) other_.push_back(m->point);
        }
      }
    std::sort(other_.begin() + static_cast<std::ptrdiff_t>(first_.back()), other_.end());
    first_.push_back(other_.size());
  }
}

}  // namespace hyperlattice::contact
