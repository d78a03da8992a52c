// Between a level and the next coarser one: trilinear interpolation in the sites' indices, and its
// transpose. Along an axis that is too short to be halved, both levels have the same sites.
#pragma once

#include <numerics/grid_level.hpp>

namespace hyperlattice::numerics {

/// Sites of the coarser level from which a site is interpolated along one axis.
struct Parents {
  int count = 1;
  std::int64_t at[2] = {};
  double weight[2] = {1, 0};
};

/// A stretch of fine sites along an axis; it may reach beyond the box.
struct Window {
  std::int64_t first, last;
};

class TrilinearTransfer {
 public:
  explicit TrilinearTransfer(const std::array<std::int64_t, 3>& fine);

  const std::array<std::int64_t, 3>& fine_sites() const { return fine_; }
  const std::array<std::int64_t, 3>& coarse_sites() const { return coarse_; }
  bool coarsens() const { return halved_[0] || halved_[1] || halved_[2]; }
  bool halved(int axis) const { return halved_[static_cast<std::size_t>(axis)]; }
  Parents parents(int axis, std::int64_t i) const {
    if (!halved(axis)) return {1, {i, i}, {1, 0}};
    return i % 2 == 0 ? Parents{1, {i / 2, i / 2}, {1, 0}}
                      : Parents{2, {i / 2, i / 2 + 1}, {0.5, 0.5}};
  }

  /// Fine sites that a coarse one, or a stiffness between it and another, is made of, if they are
  /// joined up to `reach` sites apart.
  Window window(int axis, std::int64_t coarse, int reach) const {
    return halved(axis) ? Window{2 * coarse - 1 - reach, 2 * coarse + 1 + reach}
                        : Window{coarse - reach, coarse + reach};
  }

  /// to = P^T from; both as the levels' layouts have them, four numbers a coarse site.
  void restrict_to(const GridLevel& coarse, double* to, const GridLevel& fine,
                   const double* from) const;
  /// to += P from, 0 in what cannot move.
  void prolong_from(const GridLevel& coarse, const double* from, const GridLevel& fine,
                    double* to) const;

 private:
  std::array<std::int64_t, 3> fine_, coarse_{};
  std::array<bool, 3> halved_{};
};

}  // namespace hyperlattice::numerics
