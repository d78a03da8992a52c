// Fills a solid with the sites of a structured lattice; shared by the lattice plugins.
#pragma once

#include <hyperlattice/lattice.hpp>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace hyperlattice {

/// Sends the lattice with sites x = anchor + spacing (offset + i a1 + j a2 + k a3). Each site
/// inside the shape gets a particle; with boundary cells, each cell whose centre is such a site;
/// with partial cells, each cell that has at least the share `least_share` of its volume inside.
/// The basis must have a1 along x and a2 in the plane z = 0.
class Filling {
 public:
  /// `grid`: complete but for its origin and sites. The shape must outlive this object.
  Filling(const Grid& grid, const Shape& shape, Vec3 anchor, Vec3 offset, double least_share = 0)
      : grid_(grid), shape_(shape), anchor_(anchor), offset_(offset), least_share_(least_share) {
    grid_.shape = &shape;
  }

  /// Sends grid and runs. Throws std::invalid_argument if no site is inside, or too many would be.
  void send(const LatticeSink& sink) {
    find_box();
    sink.grid(grid_);
    bool empty = true;
    for (double k = k_.first; k <= k_.last; ++k) {
      const Span rows = along_y(k);
      for (double j = rows.first; j <= rows.last; ++j) empty &= !send_row(sink, j, k);
    }
    if (empty) throw std::invalid_argument(nothing_inside);
  }

 private:
  static constexpr double most_sites = 4e9;
  /// The most steps from the anchor to a site. Above 2^53 a step more is not even another number.
  static constexpr double farthest = 2147483648.0;
  static constexpr const char* nothing_inside =
      "no lattice site or cell's centre is inside the shape, or no cell has enough of it: expected "
      "a smaller spacing or a larger shape";

  /// Steps first .. last along one of the basis vectors.
  struct Span {
    double first = infinity, last = -infinity;
    double count() const { return std::max(0.0, last - first + 1); }
    void widen(Span other) {
      if (other.count() == 0) return;
      first = std::min(first, other.first);
      last = std::max(last, other.last);
    }
  };
  static std::int32_t whole(double number) { return static_cast<std::int32_t>(number); }
  bool is_partial() const { return grid_.boundary == Boundary::partial_cells; }

  /// Sends the runs of one row. Returns whether the row has any.
  bool send_row(const LatticeSink& sink, double j, double k) const {
    if (is_partial()) return send_shares(sink, j, k);
    const auto inside = [&](double i) { return shape_.contains(place(i, j, k)); };
    const Span row = along_x(j, k);
    bool any = false;
    for (double i = row.first; i <= row.last; ++i) {
      if (!inside(i)) continue;
      const double begin = i;
      while (++i <= row.last && inside(i)) {
      }
      sink.run(whole(j - j_.first), whole(k - k_.first), whole(begin - i_.first),
               whole(i - i_.first));
      any = true;
    }
    return any;
  }

  bool send_shares(const LatticeSink& sink, double j, double k) const {
    const Span row = along_x(j, k);
    std::vector<double> shares;
    bool any = false;
    const auto send_before = [&](double i) {
      if (shares.empty()) return;
      sink.partial_run(whole(j - j_.first), whole(k - k_.first),
                       whole(i - i_.first) - static_cast<std::int32_t>(shares.size()), shares);
      shares.clear();
      any = true;
    };
    for (double i = row.first; i <= row.last; ++i) {
      const double share = shape_.share(place(i - 0.5, j - 0.5, k - 0.5), grid_.spacing);
      if (share > 0 && share >= least_share_)
        shares.push_back(share);
      else
        send_before(i);
    }
    send_before(row.last + 1);
    return any;
  }

  Vec3 place(double i, double j, double k) const {
    return anchor_ + grid_.spacing * (offset_ + combined(grid_.basis, i, j, k));
  }

  /// Returns the steps that may lie between low and high if step 0 is at `start`; the shape itself
  /// decides.
  Span between(double low, double high, double start, double step) const {
    if (!std::isfinite(low) || !std::isfinite(high))
      throw std::invalid_argument(
          "the shape has no end: expected a bounded one, such as the intersection of a half-space "
          "with a box");
    constexpr double rounding = 1e-6, most_sites_along_an_axis = 2147483646.0;
    // A partial cell may have its centre up to half a cell outside.
    const double more = is_partial() ? 0.5 - rounding : rounding;
    const Span span{std::ceil((low / grid_.spacing - start) / step - more),
                    std::floor((high / grid_.spacing - start) / step + more)};
    if (span.count() > most_sites_along_an_axis)
      throw std::invalid_argument(
          "spacing large enough for at most 2^31 sites along an axis of the shape");
    if (span.count() > 0 && std::max(std::abs(span.first), std::abs(span.last)) > farthest)
      throw std::invalid_argument(
          "anchor at most 2^31 spacings from the shape: farther off the places of sites are not "
          "exact");
    return span;
  }
  Span along_x(double j, double k) const {
    return between(shape_.low.x - anchor_.x, shape_.high.x - anchor_.x,
                   offset_.x + j * grid_.basis[1].x + k * grid_.basis[2].x, grid_.basis[0].x);
  }
  Span along_y(double k) const {
    return between(shape_.low.y - anchor_.y, shape_.high.y - anchor_.y,
                   offset_.y + k * grid_.basis[2].y, grid_.basis[1].y);
  }

  /// Finds the box of steps that contains the shape. The first step may differ from row to row and
  /// from plane to plane.
  void find_box() {
    const Vec3 size = 1 / grid_.spacing * (shape_.high - shape_.low);
    k_ = between(shape_.low.z - anchor_.z, shape_.high.z - anchor_.z, offset_.z, grid_.basis[2].z);
    widen(k_.first);
    const double about = std::max(1.0, size.x / grid_.basis[0].x) *
                         std::max(1.0, size.y / grid_.basis[1].y) * k_.count();
    if (about < most_sites)
      for (double k = k_.first; k <= k_.last; ++k) widen(k);
    if (std::max(about, i_.count() * j_.count() * k_.count()) > most_sites)
      throw std::invalid_argument(
          "spacing large enough for at most 4e9 sites in the box of the shape");
    if (i_.count() * j_.count() * k_.count() == 0) throw std::invalid_argument(nothing_inside);
    const bool cells = has_cells(grid_.boundary);  // sites are the corners of cells
    const double corner = cells ? 0.5 : 0;
    grid_.origin = place(i_.first - corner, j_.first - corner, k_.first - corner);
    const std::int32_t more = cells ? 1 : 0;
    grid_.sites = {whole(i_.count()) + more, whole(j_.count()) + more, whole(k_.count()) + more};
  }

  /// Widens the box by the rows of a plane.
  void widen(double k) {
    const Span rows = along_y(k);
    j_.widen(rows);
    for (const double j : {rows.first, rows.last}) i_.widen(along_x(j, k));
  }

  Grid grid_;
  const Shape& shape_;
  Vec3 anchor_, offset_;
  double least_share_;
  Span i_, j_, k_;
};

}  // namespace hyperlattice
