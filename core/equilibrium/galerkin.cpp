#include <equilibrium/galerkin.hpp>

#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice::equilibrium {

namespace {

struct Parent {
  std::int64_t i, j, k;
  double weight;
};

/// The coarse sites from which a site is interpolated, with weights.
struct Family {
  int count = 0;
  Parent of[8];

  Family(const TrilinearTransfer& transfer, std::int64_t i, std::int64_t j, std::int64_t k) {
    const Parents x = transfer.parents(0, i), y = transfer.parents(1, j),
                  z = transfer.parents(2, k);
    for (int c = 0; c < z.count; ++c)
      for (int b = 0; b < y.count; ++b)
        for (int a = 0; a < x.count; ++a)
          of[count++] = {x.at[a], y.at[b], z.at[c], x.weight[a] * y.weight[b] * z.weight[c]};
  }
};

/// Calls add(plane) for every fine plane, in parallel for planes that add to different coarse
/// planes. Springs end at most `reach` planes further on, so a plane adds to at most 1 + reach
/// coarse planes, beginning at its own.
template <class Add>
void plane_by_plane(std::int64_t fine_planes, std::int64_t coarse_planes, bool halved, int reach,
                    int threads, const Add& add) {
  for (std::int64_t colour = 0; colour <= reach; ++colour) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::int64_t K = colour; K < coarse_planes; K += reach + 1)
      for (std::int64_t k = halved ? 2 * K : K;
           k < std::min(fine_planes, halved ? 2 * K + 2 : K + 1); ++k)
        add(k);
  }
}

/// The set of fine sites that contribute to the blocks that the coarse level stores.
class Needed {
 public:
  Needed(const StencilLevel& coarse, const TrilinearTransfer& transfer, int reach)
      : sites_(transfer.fine_sites()) {
    needed_.assign(static_cast<std::size_t>(sites_[0] * sites_[1] * sites_[2]), 0);
    const auto inside = [&](std::size_t axis, std::int64_t at) {
      const Window window = transfer.window(static_cast<int>(axis), at, reach);
      return Window{std::max<std::int64_t>(window.first, 0),
                    std::min(window.last, sites_[axis] - 1)};
    };
    coarse.layout().for_sites([&](std::int64_t I, std::int64_t J, std::int64_t K) {
      if (!coarse.makes(coarse.layout().place(I, J, K))) return;
      const Window is = inside(0, I), js = inside(1, J), ks = inside(2, K);
      for (std::int64_t k = ks.first; k <= ks.last; ++k)
        for (std::int64_t j = js.first; j <= js.last; ++j)
          for (std::int64_t i = is.first; i <= is.last; ++i) needed_[at(i, j, k)] = 1;
    });
  }
  bool operator()(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return needed_[at(i, j, k)] != 0;
  }

 private:
  std::size_t at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * sites_[1] + j) * sites_[0] + i);
  }

  std::array<std::int64_t, 3> sites_;
  std::vector<std::uint8_t> needed_;
};

int reach_between(const TrilinearTransfer& transfer, int reach) {
  int found = 1;  // two sites `reach` apart, and their parents
  for (int axis = 0; axis < 3; ++axis)
    found = std::max(found, transfer.halved(axis) ? reach / 2 + 1 : reach);
  return found;
}

/// A coarse site from which one or both ends of a spring are interpolated.
struct End {
  std::int64_t i, j, k;
  double difference[4],
      sum[4];  ///< by component: weight at the far end minus and plus the weight at the near end
};

int collect_ends(const Family& near, std::uint8_t free_near, const Family& far,
                 std::uint8_t free_far, End* ends) {
  int count = 0;
  const auto add = [&](const Parent& parent, std::uint8_t free, double sign) {
    int n = 0;
    while (n < count && !(ends[n].i == parent.i && ends[n].j == parent.j && ends[n].k == parent.k))
      ++n;
    if (n == count) ends[count++] = {parent.i, parent.j, parent.k, {}, {}};
    for (int c = 0; c < 4; ++c)
      if ((free >> c & 1u) != 0) {
        ends[n].difference[c] += sign * parent.weight;
        ends[n].sum[c] += parent.weight;
      }
  };
  for (int p = 0; p < near.count; ++p) add(near.of[p], free_near, -1);
  for (int p = 0; p < far.count; ++p) add(far.of[p], free_far, 1);
  return count;
}

/// Computes the contributions of a spring with these ends to the coarse blocks, with places
/// relative to the coarse site `from`. Returns the number of contributions.
int parts_of(const StencilLevel& coarse, const Parent& from, const End* ends, int count,
             CoarsePart* parts) {
  const GridLayout& layout = coarse.layout();
  int found = 0;
  for (int p = 0; p < count; ++p)
    for (int q = 0; q < count; ++q) {
      const End &a = ends[p], &b = ends[q];
      const int n = coarse.neighbour(b.i - a.i, b.j - a.j, b.k - a.k);
      if (n < 0) continue;
      CoarsePart& part = parts[found++];
      const std::int64_t places =
          layout.place(a.i, a.j, a.k) - layout.place(from.i, from.j, from.k);
      part.place = places;
      part.neighbour = n;
      for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 4; ++d) {  // in a cross spring the heights of both ends add up
          part.base[4 * c + d] = a.difference[c] * b.difference[d];
          part.cross[4 * c + d] =
              (c < 3 ? a.difference[c] : a.sum[c]) * (d < 3 ? b.difference[d] : b.sum[d]);
        }
    }
  return found;
}

/// The contributions of all springs without held ends: they are equal for the same neighbour and
/// the same parity (even or odd) of the site along each axis.
class Parts {
 public:
  Parts(const StencilLevel& coarse, const TrilinearTransfer& transfer, const StaticGrid& grid) {
    std::vector<CoarsePart> most(most_parts);
    for (const NeighbourGeometry& neighbour : grid.neighbours)
      for (std::int64_t n = 0; n < 8; ++n) {
        const Neighbour& to = neighbour.site;
        const std::int64_t i = 4 + (n & 1), j = 4 + (n >> 1 & 1),
                           k = 4 + (n >> 2);  // far enough from the border
        const Family near(transfer, i, j, k), far(transfer, i + to.dx, j + to.dy, k + to.dz);
        End ends[16];
        const int count = collect_ends(near, 15, far, 15, ends);
        const int found = parts_of(coarse, near.of[0], ends, count, most.data());
        of_.emplace_back(most.begin(), most.begin() + found);
      }
  }
  const std::vector<CoarsePart>& of(std::size_t neighbour, std::int64_t i, std::int64_t j,
                                    std::int64_t k) const {
    return of_[8 * neighbour + static_cast<std::size_t>((i & 1) + 2 * (j & 1) + 4 * (k & 1))];
  }
  static constexpr std::size_t most_parts = 256;

 private:
  std::vector<std::vector<CoarsePart>> of_;
};

/// Adds the tangent of a cell to the coarse blocks between the sites from which its corners are
/// interpolated. `free`: bits of the corners' free components.
void add_cell(StencilLevel& coarse, const TrilinearTransfer& transfer, const CellTangent& tangent,
              std::int64_t i, std::int64_t j, std::int64_t k, const std::uint8_t (&free)[8]) {
  struct Site {
    Parent at;
    CellMode mode;
  };
  Site sites[27];
  int count = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const auto bits = static_cast<std::int64_t>(corner);
    const Family family(transfer, i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
    for (int p = 0; p < family.count; ++p) {
      const Parent& parent = family.of[p];
      int n = 0;
      while (n < count &&
             !(sites[n].at.i == parent.i && sites[n].at.j == parent.j && sites[n].at.k == parent.k))
        ++n;
      if (n == count) sites[count++] = {parent, {}};
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d)
          if ((free[corner] >> c & 1U) != 0)
            sites[n].mode.by[c][d] += corner_sign(corner, d) * parent.weight;
    }
  }
  for (int p = 0; p < count; ++p)
    for (int q = 0; q < count; ++q) {
      const Parent &a = sites[p].at, &b = sites[q].at;
      const int n = coarse.neighbour(b.i - a.i, b.j - a.j, b.k - a.k);
      if (n < 0) continue;
      if (double* block =
              coarse.making(coarse.layout().place(a.i, a.j, a.k), static_cast<std::size_t>(n)))
        tangent.add_block(sites[p].mode, sites[q].mode, block);
    }
}

/// Adds the stiffness of a site's numbers against their own change.
void add_own(StencilLevel& coarse, const double (&own)[4], const Family& family) {
  for (int p = 0; p < family.count; ++p)
    for (int q = 0; q < family.count; ++q) {
      const Parent &a = family.of[p], &b = family.of[q];
      const int n = coarse.neighbour(b.i - a.i, b.j - a.j, b.k - a.k);
      if (n < 0) continue;
      if (double* block =
              coarse.making(coarse.layout().place(a.i, a.j, a.k), static_cast<std::size_t>(n)))
        for (std::size_t c = 0; c < 4; ++c) block[5 * c] += own[c] * a.weight * b.weight;
    }
}

}  // namespace

std::unique_ptr<StencilLevel> coarsen(const SpringLevel& fine, const TrilinearTransfer& transfer) {
  const StaticGrid& grid = fine.grid();
  int reach = 1;
  for (const NeighbourGeometry& n : grid.neighbours)
    reach = std::max({reach, std::abs(n.site.dx), std::abs(n.site.dy), n.site.dz});
  auto coarse = std::make_unique<StencilLevel>(
      transfer.coarse_sites(), reach_between(transfer, reach),
      coarse_signatures(fine.signatures(), transfer, reach), fine.threads());
  const Needed needed(*coarse, transfer, reach);
  const auto all = static_cast<std::uint8_t>((1u << grid.components) - 1);
  const Parts alike(*coarse, transfer, grid);
  const RowKernels& kernels = row_kernels();
  plane_by_plane(
      grid.sites[2], transfer.coarse_sites()[2], transfer.halved(2), reach, fine.threads(),
      [&](std::int64_t k) {
        SpringBlocks tangent;
        End ends[16];
        std::vector<CoarsePart> own(Parts::most_parts);
        for (std::int32_t j = 0; j < grid.sites[1]; ++j) {
          const StaticRow& row =
              grid.rows[static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.sites[1]) +
                        static_cast<std::size_t>(j)];
          for (std::int64_t i = row.begin; i < row.end; ++i) {
            if (!needed(i, j, k)) continue;
            const std::int64_t place = grid.place(i, j, k);
            const Parent from{transfer.parents(0, i).at[0], transfer.parents(1, j).at[0],
                              transfer.parents(2, k).at[0], 1};
            const BlockSums sums = coarse->sums(coarse->layout().place(from.i, from.j, from.k));
            for (std::size_t n = 0; n < grid.neighbours.size(); ++n) {
              if (!fine.tangent(n, place, tangent)) continue;
              const Neighbour& to = grid.neighbours[n].site;
              const std::uint8_t free_here = grid.free[place],
                                 free_there = grid.free[place + grid.step_to(to)];
              if (free_here == all && free_there == all) {
                const std::vector<CoarsePart>& parts = alike.of(n, i, j, k);
                kernels.add_spring(sums, parts.data(), static_cast<int>(parts.size()), tangent.base,
                                   tangent.cross);
                continue;
              }
              const Family near(transfer, i, j, k), far(transfer, i + to.dx, j + to.dy, k + to.dz);
              const int count = collect_ends(near, free_here, far, free_there, ends);
              kernels.add_spring(sums, own.data(), parts_of(*coarse, from, ends, count, own.data()),
                                 tangent.base, tangent.cross);
            }
            if (CellTangent cell; fine.cell(place, cell)) {
              std::uint8_t free[8];
              for (std::int64_t n = 0; n < 8; ++n)
                free[n] =
                    grid.free[place + (n & 1) + (n >> 1 & 1) * grid.row + (n >> 2) * grid.plane];
              add_cell(*coarse, transfer, cell, i, j, k, free);
            }
            if (!fine.has_own()) continue;
            double own[4] = {};
            for (int c = 0; c < grid.components; ++c)
              if ((grid.free[place] >> c & 1u) != 0)
                own[c] = double{fine.own(c, static_cast<std::size_t>(place))};
            add_own(*coarse, own, Family(transfer, i, j, k));
          }
        }
      });
  coarse->finish();
  return coarse;
}

std::unique_ptr<StencilLevel> coarsen(const StencilLevel& fine, const TrilinearTransfer& transfer) {
  const GridLayout& from = fine.layout();
  auto coarse = std::make_unique<StencilLevel>(
      transfer.coarse_sites(), reach_between(transfer, fine.reach()),
      coarse_signatures(fine.signatures(), transfer, fine.reach()), fine.threads());
  const Needed needed(*coarse, transfer, fine.reach());
  const RowKernels& kernels = row_kernels();
  plane_by_plane(
      from.sites[2], transfer.coarse_sites()[2], transfer.halved(2), fine.reach(), fine.threads(),
      [&](std::int64_t k) {
        double turned[16];
        for (std::int64_t j = 0; j < from.sites[1]; ++j)
          for (std::int64_t i = 0; i < from.sites[0]; ++i) {
            if (!needed(i, j, k)) continue;
            const std::int64_t place = from.place(i, j, k);
            const Family near(transfer, i, j, k);
            for (std::int64_t dk = 0; dk <= fine.reach(); ++dk)
              for (std::int64_t dj = -fine.reach(); dj <= fine.reach(); ++dj)
                for (std::int64_t di = -fine.reach(); di <= fine.reach(); ++di) {
                  const int n = fine.neighbour(di, dj, dk);
                  if (n < 0 || i + di < 0 || j + dj < 0 || i + di >= from.sites[0] ||
                      j + dj >= from.sites[1] || k + dk >= from.sites[2])
                    continue;
                  const double* block = fine.block(place, static_cast<std::size_t>(n));
                  for (int a = 0; a < 4; ++a)
                    for (int b = 0; b < 4; ++b) turned[4 * b + a] = block[4 * a + b];
                  const Family far(transfer, i + di, j + dj, k + dk);
                  for (int p = 0; p < near.count; ++p)
                    for (int q = 0; q < far.count; ++q) {
                      const Parent &P = near.of[p], &Q = far.of[q];
                      const int to = coarse->neighbour(Q.i - P.i, Q.j - P.j, Q.k - P.k);
                      const double weight = P.weight * Q.weight;
                      const auto add = [&](const Parent& at, int neighbour, const double* what) {
                        if (double* sum = coarse->making(coarse->layout().place(at.i, at.j, at.k),
                                                         static_cast<std::size_t>(neighbour)))
                          kernels.add_block(sum, weight, what);
                      };
                      if (to >= 0) add(P, to, block);
                      if (to <= 0 && n != 0)
                        add(Q, -to, turned);  // the transposed block, from the other end
                    }
                }
          }
      });
  coarse->finish();
  return coarse;
}

}  // namespace hyperlattice::equilibrium
