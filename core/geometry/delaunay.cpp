// Points are inserted one after the other (Bowyer 1981, Watson 1981): the tetrahedra whose spheres
// hold the new point are replaced by those between the point and the faces around them. All points
// lie in one large tetrahedron, whose corners are left out at the end. The order of insertion is
// random in rounds and along a curve within a round (Amenta, Choi and Rote 2003).
//
// Coordinates are integers, so that the signs of all determinants are exact: in doubles where their
// error bound allows it (Shewchuk 1997), otherwise in integers of 256 bits. Only the strict inside
// of a sphere counts. If a new tetrahedron is flat, the point is moved by a few steps and inserted
// again.
#include <geometry/delaunay.hpp>

#include <hyperlattice/chance.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hyperlattice {
namespace {

using Wide = boost::multiprecision::int256_t;
using Index = std::uint32_t;
/// A point in steps of the grid: integers below 2^38 in absolute value, so that their differences
/// are exact in doubles.
using GridPoint = std::array<std::int64_t, 3>;

constexpr std::int64_t grid_steps = std::int64_t{1} << 32;  ///< along the longest edge of the box

template <class Number>
using Row = std::array<Number, 3>;

template <class Number>
Row<Number> difference(const GridPoint& a, const GridPoint& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <class Number>
Number determinant(const Row<Number>& a, const Row<Number>& b, const Row<Number>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Returns the same sum with the absolute values of all products.
double permanent(const Row<double>& a, const Row<double>& b, const Row<double>& c) {
  const auto pair = [&](std::size_t p, std::size_t q) {
    return std::abs(b[p] * c[q]) + std::abs(b[q] * c[p]);
  };
  return std::abs(a[0]) * pair(1, 2) + std::abs(a[1]) * pair(0, 2) + std::abs(a[2]) * pair(0, 1);
}

template <class Number>
Number square(const Row<Number>& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

int sign_of(const Wide& value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// Returns the sign of the volume of a tetrahedron.
int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  constexpr double rounding = 1e-15;
  const Row<double> ab = difference<double>(b, a), ac = difference<double>(c, a),
                    ad = difference<double>(d, a);
  const double value = determinant(ab, ac, ad);
  if (std::abs(value) > rounding * permanent(ab, ac, ad)) return value > 0 ? 1 : -1;
  return sign_of(
      determinant(difference<Wide>(b, a), difference<Wide>(c, a), difference<Wide>(d, a)));
}

template <class Number>
Number sphere_determinant(const std::array<Row<Number>, 4>& r) {
  return square(r[0]) * determinant(r[1], r[2], r[3]) -
         square(r[1]) * determinant(r[0], r[2], r[3]) +
         square(r[2]) * determinant(r[0], r[1], r[3]) -
         square(r[3]) * determinant(r[0], r[1], r[2]);
}

/// Returns whether a point is strictly inside of the sphere through four corners of positive
/// orientation.
bool is_inside(const std::array<GridPoint, 4>& corners, const GridPoint& point) {
  constexpr double rounding = 4e-15;
  const auto rows = [&]<class Number>(Number) {
    return std::array{difference<Number>(corners[0], point), difference<Number>(corners[1], point),
                      difference<Number>(corners[2], point), difference<Number>(corners[3], point)};
  };
  const std::array<Row<double>, 4> r = rows(0.0);
  const double value = sphere_determinant(r), size = square(r[0]) * permanent(r[1], r[2], r[3]) +
                                                     square(r[1]) * permanent(r[0], r[2], r[3]) +
                                                     square(r[2]) * permanent(r[0], r[1], r[3]) +
                                                     square(r[3]) * permanent(r[0], r[1], r[2]);
  if (std::abs(value) > rounding * size) return value > 0;
  return sphere_determinant(rows(Wide())) > 0;
}

class Triangulation {
 public:
  explicit Triangulation(std::span<const Vec3> points) : count_(static_cast<Index>(points.size())) {
    place(points);
    add_hull();
    for (const Index point : order()) insert(point);
  }

  /// Returns the tetrahedra between the points, without those at the corners of the large one.
  std::vector<Tetrahedron> take() const {
    std::vector<Index> number(all_.size(), no_tetrahedron);
    Index found = 0;
    for (std::size_t t = 0; t < all_.size(); ++t)
      if (std::all_of(all_[t].corners.begin(), all_[t].corners.end(),
                      [this](Index corner) { return corner < count_; }))
        number[t] = found++;
    std::vector<Tetrahedron> taken(found);
    for (std::size_t t = 0; t < all_.size(); ++t) {
      if (number[t] == no_tetrahedron) continue;
      Tetrahedron& to = taken[number[t]];
      to = all_[t];
      for (Index& neighbour : to.neighbours)
        if (neighbour != no_tetrahedron) neighbour = number[neighbour];
    }
    return taken;
  }

 private:
  /// A face between the tetrahedra to replace and the others.
  struct Face {
    Index inside, corner;  ///< a tetrahedron to replace, and its corner opposite to the face
    std::size_t back;      ///< corner opposite to the face of the tetrahedron beyond
  };
  /// A face of a new tetrahedron at the new point: its edge opposite to the point.
  struct Side {
    std::uint64_t edge;
    Index tetrahedron, corner;
    bool operator<(const Side& other) const { return edge < other.edge; }
  };

  void place(std::span<const Vec3> points) {
    Vec3 low = points.empty() ? Vec3{} : points.front(), high = low;
    for (const Vec3 x : points)
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], x[c]);
        high[c] = std::max(high[c], x[c]);
      }
    const double edge = std::max({high.x - low.x, high.y - low.y, high.z - low.z}),
                 scale = edge > 0 ? static_cast<double>(grid_steps) / edge : 0;
    at_.reserve(points.size() + 4);
    for (const Vec3 x : points)
      at_.push_back({std::llround(scale * (x.x - low.x)), std::llround(scale * (x.y - low.y)),
                     std::llround(scale * (x.z - low.z))});
  }

  void add_hull() {
    constexpr std::int64_t far = 8 * grid_steps;
    const std::array<GridPoint, 4> corners{{{-far - 7, -far - 3, -far - 1},
                                            {4 * far + 5, -far - 9, -far - 2},
                                            {-far - 4, 4 * far + 11, -far - 6},
                                            {-far - 10, -far - 8, 4 * far + 13}}};
    at_.insert(at_.end(), corners.begin(), corners.end());
    all_.push_back({{count_, count_ + 1, count_ + 2, count_ + 3},
                    {no_tetrahedron, no_tetrahedron, no_tetrahedron, no_tetrahedron}});
    is_replaced_.push_back(0);
  }

  /// Returns the points in the order of insertion.
  std::vector<Index> order() const {
    struct Key {
      std::uint64_t round, curve;
      Index point;
    };
    std::vector<Key> keys;
    keys.reserve(count_);
    for (Index p = 0; p < count_; ++p) {
      const double drawn = chance(1, p, 0);
      std::uint64_t round = 0;
      for (double left = 0.5; drawn < left && (count_ >> round) > 64; left /= 2) ++round;
      std::uint64_t curve = 0;
      for (int bit = 20; bit >= 0; --bit)
        for (const std::int64_t x : at_[p])
          curve = curve << 1 | (static_cast<std::uint64_t>(x) >> (bit + 12) & 1U);
      keys.push_back({~round, curve, p});
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
      return a.round != b.round   ? a.round < b.round
             : a.curve != b.curve ? a.curve < b.curve
                                  : a.point < b.point;
    });
    std::vector<Index> points;
    points.reserve(keys.size());
    for (const Key& key : keys) points.push_back(key.point);
    return points;
  }

  void insert(Index point) {
    const GridPoint original = at_[point];
    constexpr std::uint64_t most = 60;
    for (std::uint64_t attempt = 0; !replace_around(point); ++attempt) {
      if (attempt == most) throw std::logic_error("a point has no place in the triangulation");
      const double reach =
          static_cast<double>(std::int64_t{1} << (8 + std::min(attempt, most / 10)));
      for (std::size_t c = 0; c < 3; ++c)
        at_[point][c] = original[c] + std::llround(reach * (2 * chance(2 + attempt, point, c) - 1));
    }
  }

  std::array<GridPoint, 4> corners_of(const Tetrahedron& of) const {
    return {at_[of.corners[0]], at_[of.corners[1]], at_[of.corners[2]], at_[of.corners[3]]};
  }
  /// Returns the orientation of a tetrahedron with another point in the place of one corner.
  int orientation_with(const Tetrahedron& of, std::size_t corner, const GridPoint& point) const {
    std::array<GridPoint, 4> corners = corners_of(of);
    corners[corner] = point;
    return orientation(corners[0], corners[1], corners[2], corners[3]);
  }

  /// Returns a tetrahedron that holds the point, on a walk from the last new one: through any face
  /// that has the point on its other side.
  Index find(const GridPoint& point) const {
    Index here = last_;
    for (bool arrived = false; !arrived;) {
      arrived = true;
      for (std::size_t n = 0; n < 4 && arrived; ++n) {
        const Index next = all_[here].neighbours[n];
        if (next == no_tetrahedron || orientation_with(all_[here], n, point) >= 0) continue;
        here = next;
        arrived = false;
      }
    }
    return here;
  }

  std::size_t face_to(Index tetrahedron, Index neighbour) const {
    const auto& all = all_[tetrahedron].neighbours;
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), neighbour) - all.begin());
  }

  /// Inserts a point. Changes nothing and returns false if a new tetrahedron would be flat.
  bool replace_around(Index point) {
    const GridPoint at = at_[point];
    replaced_.assign(1, find(at));
    is_replaced_[replaced_.front()] = 1;
    faces_.clear();
    for (std::size_t n = 0; n < replaced_.size(); ++n) {
      const Index here = replaced_[n];
      for (Index corner = 0; corner < 4; ++corner) {
        const Index next = all_[here].neighbours[corner];
        if (next != no_tetrahedron && is_replaced_[next] != 0) continue;
        if (next != no_tetrahedron && is_inside(corners_of(all_[next]), at)) {
          is_replaced_[next] = 1;
          replaced_.push_back(next);
        } else {
          faces_.push_back({here, corner, next == no_tetrahedron ? 0 : face_to(next, here)});
        }
      }
    }
    const bool is_star = std::all_of(faces_.begin(), faces_.end(), [&](const Face& face) {
      return orientation_with(all_[face.inside], face.corner, at) > 0;
    });
    for (const Index replaced : replaced_) is_replaced_[replaced] = 0;
    if (is_star) join(point);
    return is_star;
  }

  /// Replaces the tetrahedra by those between the point and the faces.
  void join(Index point) {
    made_.clear();
    for (const Face& face : faces_) {
      Tetrahedron made = all_[face.inside];
      made.corners[face.corner] = point;
      made_.push_back(made);
    }
    take_places(made_.size());
    sides_.clear();
    for (std::size_t n = 0; n < made_.size(); ++n) {
      const Index number = replaced_[n], opposite = faces_[n].corner,
                  beyond = made_[n].neighbours[opposite];
      if (beyond != no_tetrahedron) all_[beyond].neighbours[faces_[n].back] = number;
      for (Index corner = 0; corner < 4; ++corner) {
        if (corner == opposite) continue;
        std::uint64_t ends[2] = {};
        std::size_t found = 0;
        for (Index other = 0; other < 4; ++other)
          if (other != corner && other != opposite) ends[found++] = made_[n].corners[other];
        sides_.push_back(
            {std::min(ends[0], ends[1]) << 32 | std::max(ends[0], ends[1]), number, corner});
      }
    }
    for (std::size_t n = 0; n < made_.size(); ++n) all_[replaced_[n]] = made_[n];
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t n = 0; n + 1 < sides_.size(); n += 2) {
      all_[sides_[n].tetrahedron].neighbours[sides_[n].corner] = sides_[n + 1].tetrahedron;
      all_[sides_[n + 1].tetrahedron].neighbours[sides_[n + 1].corner] = sides_[n].tetrahedron;
    }
    last_ = replaced_.front();
  }

  /// Makes `replaced_` the places of this many new tetrahedra.
  void take_places(std::size_t number) {
    while (replaced_.size() > number) {
      all_[replaced_.back()].corners.fill(no_tetrahedron);  // a corner that no point is
      free_.push_back(replaced_.back());
      replaced_.pop_back();
    }
    while (replaced_.size() < number) {
      if (free_.empty()) {
        free_.push_back(static_cast<Index>(all_.size()));
        all_.emplace_back();
        is_replaced_.push_back(0);
      }
      replaced_.push_back(free_.back());
      free_.pop_back();
    }
  }

  Index count_;
  std::vector<GridPoint> at_;
  std::vector<Tetrahedron> all_;
  std::vector<std::uint8_t> is_replaced_;
  std::vector<Index> free_;  ///< places in `all_` without a tetrahedron
  Index last_ = 0;
  // of the insertion in work
  std::vector<Index> replaced_;
  std::vector<Face> faces_;
  std::vector<Tetrahedron> made_;
  std::vector<Side> sides_;
};

}  // namespace

std::vector<Tetrahedron> delaunay(std::span<const Vec3> points) {
  constexpr std::size_t most = std::size_t{1} << 27;
  if (points.size() > most) throw std::invalid_argument("too many points to triangulate");
  return Triangulation(points).take();
}

}  // namespace hyperlattice
