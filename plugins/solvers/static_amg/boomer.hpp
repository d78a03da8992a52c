// BoomerAMG, the algebraic multigrid of hypre: one symmetric V-cycle, set up for elasticity.
#pragma once

#include "fields.hpp"

#include <HYPRE_utilities.h>

#include <memory>

namespace hyperlattice::statics {

/// A square sparse matrix, row by row.
struct SparseRows {
  std::vector<HYPRE_Int> entries;  ///< of each row, how many
  std::vector<HYPRE_BigInt> column;
  Field value;
};

class Boomer {
 public:
  /// Of a symmetric matrix in which the `components` rows of a particle follow each other. Entries above `strong_threshold` of the largest in their
  /// row couple strongly. All of these throw std::runtime_error with what hypre complains of.
  Boomer(const SparseRows& rows, int components, double strong_threshold);
  ~Boomer();

  /// z, about the inverse times r.
  void apply(const Field& r, Field& z);

 private:
  struct Handles;
  std::vector<HYPRE_BigInt> all_;  ///< 0, 1, 2 ...: the rows
  std::unique_ptr<Handles> handles_;
};

}  // namespace hyperlattice::statics
