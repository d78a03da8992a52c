// The cells that a body with boundary "cells" or "partial_cells" consists of. Cell (i, j, k) spans
// the sites from (i, j, k) to (i + 1, j + 1, k + 1): its corners are particles, its edges and
// diagonals are springs. A whole cell has the share 1, a partial cell the share of its volume that
// is inside the shape. A particle or spring belongs to several cells; its share is their mean, in
// which a cell that does not exist counts 0. See docs/theory/boundaries.md.
#pragma once

#include <model/sites.hpp>

#include <hyperlattice/lattice.hpp>

#include <span>
#include <vector>

namespace hyperlattice {

/// Calls visit(di, dj, dk) for each cell of the spring from a site to a neighbour; with `to` {} for
/// each cell around the site. The arguments are the offset of the cell from the cell of the site.
/// The steps of a neighbour are -1, 0 or 1.
template <class Visit>
void for_cells_of(const Neighbour& to, const Visit& visit) {
  for (int dk = to.dz > 0 ? 0 : -1; dk <= (to.dz < 0 ? -1 : 0); ++dk)
    for (int dj = to.dy > 0 ? 0 : -1; dj <= (to.dy < 0 ? -1 : 0); ++dj)
      for (int di = to.dx > 0 ? 0 : -1; di <= (to.dx < 0 ? -1 : 0); ++di) visit(di, dj, dk);
}

/// Returns the mean of share_of(di, dj, dk), the share of a cell, over those cells.
template <class ShareOf>
double mean_share(const Neighbour& to, const ShareOf& share_of) {
  int cells = 0;
  double sum = 0;
  for_cells_of(to, [&](int di, int dj, int dk) {
    ++cells;
    sum += share_of(di, dj, dk);
  });
  return sum / cells;
}

/// Shares are multiples of 2^-20: sums over eight cells are then exact, in floats too, whatever
/// their order, and equal cells have equal bits. A float holds each share exactly.
inline constexpr double smallest_share = 0x1p-20;

/// A cell that counts with less than its whole volume.
struct PartialCell {
  Particle cell = 0;  ///< its index in the order of Cells::runs()
  float share = 1;    ///< above 0, below 1
};

class Cells {
 public:
  Cells() = default;
  /// Takes the runs in the order z, y, x, and the first run of each row [k * rows + j], with one
  /// more entry at the end.
  /// `partial`: the cells that are not whole, ascending.
  Cells(std::vector<Run> runs, std::vector<std::size_t> row_runs, std::int32_t rows,
        std::vector<PartialCell> partial = {});

  bool empty() const { return runs_.empty(); }
  std::uint64_t count() const { return count_; }
  std::span<const Run> runs() const { return runs_; }
  /// Returns the runs of a row; none outside the box.
  std::span<const Run> row(std::int32_t j, std::int32_t k) const;
  bool holds(Site cell) const { return at(cell) != ~Particle{0}; }
  /// Returns the index of a cell in the order of runs(); ~0 if the cell does not exist.
  Particle at(Site cell) const;
  /// Returns the share of a cell, 0 to 1: 1 if it is whole, 0 if it does not exist.
  double share_of_cell(Site cell) const;
  /// Returns the share of an existing cell, given its index in the order of runs().
  double share_of_cell(Particle cell) const;
  bool has_partial() const { return !partial_.empty(); }
  std::span<const PartialCell> partial() const { return partial_; }
  /// Returns the sum of all shares: the volume in whole cells.
  double volume() const;

  /// Returns the share of a spring; with `to` {} that of the particle at the site.
  double share(Site site, const Neighbour& to = {}) const;
  /// Returns the sites of row (j, k) with a share above 0, ascending and disjoint.
  std::vector<Range> sites(std::int32_t j, std::int32_t k, const Neighbour& to = {}) const;

 private:
  std::vector<Run> runs_;
  std::vector<std::size_t> row_runs_;
  std::vector<PartialCell> partial_;
  std::int32_t rows_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace hyperlattice
