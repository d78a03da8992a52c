// The tangents of a lattice's springs in the order in which the product K x reads them: row by row,
// eight places at a time with all their springs. Equal rows are stored once, so that the rows of an
// undeformed body mostly stay in the processor's caches.
#pragma once

#include <equilibrium/numerics.hpp>

#include <hyperlattice/statics.hpp>

#include <unordered_map>

namespace hyperlattice::equilibrium {

class TangentRows {
 public:
  /// Copies the tangents into this order. In a deformed body pulls are included, and rows are not
  /// compared because no two are equal.
  void pack(const StaticGrid& grid, const SpringTangents& tangents, bool deformed);

  /// Returns the tangents of a row, N/m, [group of eight places][neighbour][kind][place], with the
  /// kinds axial, cross axial, pull and cross pull that the body has, and zeros beyond the row's
  /// end; null for an empty row.
  const float* row(std::size_t number) const {
    return row_[number] < 0 ? nullptr : packed_.data() + row_[number];
  }

 private:
  std::vector<std::int64_t> row_;  ///< start of each row in packed_; -1: empty row
  Floats packed_;
};

}  // namespace hyperlattice::equilibrium
