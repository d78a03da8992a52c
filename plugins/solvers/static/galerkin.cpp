#include "galerkin.hpp"

namespace hyperlattice::statics {

namespace {

struct Parent {
  std::int64_t i, j, k;
  float weight;
};

/// Coarse sites from which a site is interpolated.
struct Family {
  int count = 0;
  Parent of[8];

  Family(const Transfer& transfer, std::int64_t i, std::int64_t j, std::int64_t k) {
    const Parents x = transfer.parents(0, i), y = transfer.parents(1, j), z = transfer.parents(2, k);
    for (int c = 0; c < z.count; ++c)
      for (int b = 0; b < y.count; ++b)
        for (int a = 0; a < x.count; ++a) of[count++] = {x.at[a], y.at[b], z.at[c], x.weight[a] * y.weight[b] * z.weight[c]};
  }
};

/// Runs add(plane) for every fine plane: those whose coarse planes may be shared follow each other, the others run at once. A plane's springs end at
/// most `reach` planes on, so that it adds to no more than 1 + reach coarse planes from its own coarse one on.
template <class Add>
void plane_by_plane(std::int64_t fine_planes, std::int64_t coarse_planes, bool halved, int reach, int threads, const Add& add) {
  for (std::int64_t colour = 0; colour <= reach; ++colour) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::int64_t K = colour; K < coarse_planes; K += reach + 1)
      for (std::int64_t k = halved ? 2 * K : K; k < std::min(fine_planes, halved ? 2 * K + 2 : K + 1); ++k) add(k);
  }
}

int reach_between(const Transfer& transfer, int reach) {
  int found = 1;  // two sites `reach` apart, and their parents
  for (int axis = 0; axis < 3; ++axis) found = std::max(found, transfer.halved(axis) ? reach / 2 + 1 : reach);
  return found;
}

/// A coarse site that both ends of a spring, or one, are interpolated from.
struct End {
  std::int64_t i, j, k;
  float difference[4], sum[4];  ///< by component: weight at the far end less that at the near one, and both together
};

int collect_ends(const Family& near, std::uint8_t free_near, const Family& far, std::uint8_t free_far, End* ends) {
  int count = 0;
  const auto add = [&](const Parent& parent, std::uint8_t free, float sign) {
    int n = 0;
    while (n < count && !(ends[n].i == parent.i && ends[n].j == parent.j && ends[n].k == parent.k)) ++n;
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

void add_spring(StencilLevel& coarse, const SpringLevel::Tangent& t, const End* ends, int count, bool heights) {
  const Layout& layout = coarse.layout();
  for (int p = 0; p < count; ++p)
    for (int q = 0; q < count; ++q) {
      const int n = coarse.neighbour(ends[q].i - ends[p].i, ends[q].j - ends[p].j, ends[q].k - ends[p].k);
      if (n < 0) continue;
      float* block = coarse.block(layout.place(ends[p].i, ends[p].j, ends[p].k), static_cast<std::size_t>(n));
      const End &a = ends[p], &b = ends[q];
      float left[4], right[4];  // of the cross spring: heights add up
      for (int c = 0; c < 3; ++c) left[c] = a.difference[c], right[c] = b.difference[c];
      left[3] = a.sum[3];
      right[3] = b.sum[3];
      for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 4; ++d) block[4 * c + d] += t.base[4 * c + d] * a.difference[c] * b.difference[d];
      if (!heights) continue;
      for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 4; ++d) block[4 * c + d] += t.cross[4 * c + d] * left[c] * right[d];
    }
}

void add_alpha(StencilLevel& coarse, float alpha, const Family& family) {
  for (int p = 0; p < family.count; ++p)
    for (int q = 0; q < family.count; ++q) {
      const Parent &a = family.of[p], &b = family.of[q];
      const int n = coarse.neighbour(b.i - a.i, b.j - a.j, b.k - a.k);
      if (n >= 0) coarse.block(coarse.layout().place(a.i, a.j, a.k), static_cast<std::size_t>(n))[15] += alpha * a.weight * b.weight;
    }
}

}  // namespace

std::unique_ptr<StencilLevel> coarsen(const SpringLevel& fine, const Transfer& transfer) {
  const StaticGrid& grid = fine.grid();
  int reach = 1;
  for (const NeighbourGeometry& n : grid.neighbours) reach = std::max({reach, std::abs(n.site.dx), std::abs(n.site.dy), n.site.dz});
  auto coarse = std::make_unique<StencilLevel>(transfer.coarse_sites(), reach_between(transfer, reach), fine.threads());
  const bool heights = grid.components == 4;
  plane_by_plane(grid.sites[2], transfer.coarse_sites()[2], transfer.halved(2), reach, fine.threads(), [&](std::int64_t k) {
    SpringLevel::Tangent tangent;
    End ends[16];
    for (std::int32_t j = 0; j < grid.sites[1]; ++j) {
      const StaticRow& row = grid.rows[static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.sites[1]) + static_cast<std::size_t>(j)];
      for (std::int64_t i = row.begin; i < row.end; ++i) {
        const std::int64_t place = grid.place(i, j, k);
        const Family near(transfer, i, j, k);
        for (std::size_t n = 0; n < grid.neighbours.size(); ++n) {
          if (!fine.tangent(n, place, tangent)) continue;
          const Neighbour& to = grid.neighbours[n].site;
          const Family far(transfer, i + to.dx, j + to.dy, k + to.dz);
          const int count = collect_ends(near, grid.free[place], far, grid.free[place + grid.step_to(to)], ends);
          add_spring(*coarse, tangent, ends, count, heights);
        }
        if (heights && (grid.free[place] >> 3 & 1u) != 0) add_alpha(*coarse, fine.alpha(place), near);
      }
    }
  });
  coarse->finish();
  return coarse;
}

std::unique_ptr<StencilLevel> coarsen(const StencilLevel& fine, const Transfer& transfer) {
  const Layout& from = fine.layout();
  auto coarse = std::make_unique<StencilLevel>(transfer.coarse_sites(), reach_between(transfer, fine.reach()), fine.threads());
  const RowKernels& kernels = row_kernels();
  plane_by_plane(from.sites[2], transfer.coarse_sites()[2], transfer.halved(2), fine.reach(), fine.threads(), [&](std::int64_t k) {
    float turned[16];
    for (std::int64_t j = 0; j < from.sites[1]; ++j)
      for (std::int64_t i = 0; i < from.sites[0]; ++i) {
        const std::int64_t place = from.place(i, j, k);
        const Family near(transfer, i, j, k);
        for (std::int64_t dk = 0; dk <= fine.reach(); ++dk)
          for (std::int64_t dj = -fine.reach(); dj <= fine.reach(); ++dj)
            for (std::int64_t di = -fine.reach(); di <= fine.reach(); ++di) {
              const int n = fine.neighbour(di, dj, dk);
              if (n < 0 || i + di < 0 || j + dj < 0 || i + di >= from.sites[0] || j + dj >= from.sites[1] || k + dk >= from.sites[2]) continue;
              const float* block = fine.block(place, static_cast<std::size_t>(n));
              for (int a = 0; a < 4; ++a)
                for (int b = 0; b < 4; ++b) turned[4 * b + a] = block[4 * a + b];
              const Family far(transfer, i + di, j + dj, k + dk);
              for (int p = 0; p < near.count; ++p)
                for (int q = 0; q < far.count; ++q) {
                  const Parent &P = near.of[p], &Q = far.of[q];
                  const int to = coarse->neighbour(Q.i - P.i, Q.j - P.j, Q.k - P.k);
                  const float weight = P.weight * Q.weight;
                  const auto add = [&](const Parent& at, int neighbour, const float* what) {
                    kernels.add_block(coarse->block(coarse->layout().place(at.i, at.j, at.k), static_cast<std::size_t>(neighbour)), weight, what);
                  };
                  if (to >= 0) add(P, to, block);
                  if (to <= 0 && n != 0) add(Q, -to, turned);  // the same block from the other end
                }
            }
      }
  });
  coarse->finish();
  return coarse;
}

}  // namespace hyperlattice::statics
