// Transfer between a level and the next coarser one: trilinear interpolation P in the sites'
// indices, and its transpose. Along an axis that is too short to be halved, both levels have the
// same sites.
#pragma once

#include <numerics/grid_level.hpp>

namespace hyperlattice::numerics {

/// Coarse sites, with weights, from which a fine site is interpolated along one axis.
struct Parents {
  int count = 1;
  std::int64_t at[2] = {};
  double weight[2] = {1, 0};
};

/// A range of fine sites along an axis, last included; it may extend beyond the box.
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

  /// Returns the fine sites that contribute to a coarse site, or to a stiffness between it and
  /// another, if fine sites up to `reach` apart are connected.
  Window window(int axis, std::int64_t coarse, int reach) const {
    return halved(axis) ? Window{2 * coarse - 1 - reach, 2 * coarse + 1 + reach}
                        : Window{coarse - reach, coarse + reach};
  }

  /// Computes to = P^T from, both in the layouts of their levels, with four numbers for each coarse
  /// site.
  void restrict_to(const GridLevel& coarse, double* to, const GridLevel& fine,
                   const double* from) const;
  /// Computes to += P from; sets components that cannot move to 0.
  void prolong_from(const GridLevel& coarse, const double* from, const GridLevel& fine,
                    double* to) const;

 private:
  std::array<std::int64_t, 3> fine_, coarse_{};
  std::array<bool, 3> halved_{};
};

}  // namespace hyperlattice::numerics
