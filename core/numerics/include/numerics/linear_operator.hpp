// What iterative solvers know of the linear equations A x = b.
#pragma once

#include <numerics/fields.hpp>

namespace hyperlattice::numerics {

/// A symmetric matrix A, of which only products are known. Some numbers of a field may be no
/// unknowns; A has zeros in their rows.
class LinearOperator {
 public:
  LinearOperator() = default;
  virtual ~LinearOperator() = default;
  LinearOperator(const LinearOperator&) = delete;
  LinearOperator& operator=(const LinearOperator&) = delete;

  virtual std::size_t numbers() const = 0;  ///< of a field: rows of A
  virtual int threads() const = 0;          ///< for arithmetic on fields
  /// y = A x, 0 where there is no unknown.
  virtual void multiply(const double* x, double* y) const = 0;
  /// Sets to zero what is no unknown.
  virtual void mask(double* x) const = 0;
};

class Preconditioner {
 public:
  Preconditioner() = default;
  virtual ~Preconditioner() = default;
  Preconditioner(const Preconditioner&) = delete;
  Preconditioner& operator=(const Preconditioner&) = delete;

  virtual void apply(const Field& r, Field& z) = 0;  ///< z, about A^-1 r
};

/// A subspace, as a rule A's null space, in which a solution shall have no part.
class Deflation {
 public:
  Deflation() = default;
  virtual ~Deflation() = default;
  Deflation(const Deflation&) = delete;
  Deflation& operator=(const Deflation&) = delete;

  virtual void remove_from(Field& field) const = 0;  ///< orthogonal projection onto what is left
};

}  // namespace hyperlattice::numerics
