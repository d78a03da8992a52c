// The cells whose union is a body with boundary "cells". Cell (i, j, k) spans the sites from (i, j,
// k) to (i + 1, j + 1, k + 1): its corners are particles, its edges and diagonals are springs. A
// particle or spring inside the body belongs to several cells; at a surface its share is the
// fraction of these cells that exist. See docs/theory/boundaries.md.
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

/// Returns the fraction of those cells for which present(di, dj, dk) holds.
template <class Present>
double share_of_cells(const Neighbour& to, const Present& present) {
  int all = 0, there = 0;
  for_cells_of(to, [&](int di, int dj, int dk) {
    ++all;
    if (present(di, dj, dk)) ++there;
  });
  return static_cast<double>(there) / all;
}

class Cells {
 public:
  Cells() = default;
  /// Takes the runs in the order z, y, x, and the first run of each row [k * rows + j], with one
  /// more entry at the end.
  Cells(std::vector<Run> runs, std::vector<std::size_t> row_runs, std::int32_t rows);

  bool empty() const { return runs_.empty(); }
  std::uint64_t count() const { return count_; }
  std::span<const Run> runs() const { return runs_; }
  /// Returns the runs of a row; none outside the box.
  std::span<const Run> row(std::int32_t j, std::int32_t k) const;
  bool holds(Site cell) const { return at(cell) != ~Particle{0}; }
  /// Returns the index of a cell in the order of runs(); ~0 if the cell does not exist.
  Particle at(Site cell) const;

  /// Returns the share of a spring; with `to` {} that of the particle at the site.
  double share(Site site, const Neighbour& to = {}) const;
  /// Returns the sites of row (j, k) with a share above 0, ascending and disjoint.
  std::vector<Range> sites(std::int32_t j, std::int32_t k, const Neighbour& to = {}) const;

 private:
  std::vector<Run> runs_;
  std::vector<std::size_t> row_runs_;
  std::int32_t rows_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace hyperlattice
