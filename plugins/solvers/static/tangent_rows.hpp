// The tangents of a lattice's springs in the order in which a product needs them: row by row, eight
// places at a time, all springs of these one after the other. Rows that are alike are kept once, so
// that those of an undeformed body mostly stay in the processor's caches.
#pragma once

#include "numerics.hpp"

#include <hyperlattice/statics.hpp>

#include <unordered_map>

namespace hyperlattice::statics {

class TangentRows {
 public:
  /// Of a deformed body no two rows are alike, and pulls count too.
  void pack(const StaticGrid& grid, const SpringTangents& tangents, bool deformed);

  /// [eight places][neighbour][axial, of cross springs, pull, of cross springs; those that the body
  /// has][place]; zeros past the row's end. Null: empty.
  const float* row(std::size_t number) const {
    return row_[number] < 0 ? nullptr : packed_.data() + row_[number];
  }

 private:
  std::vector<std::int64_t> row_;  ///< where each begins
  Floats packed_;
};

}  // namespace hyperlattice::statics
