// Interfaces of iterative solvers for the linear equations A x = b.
#pragma once

#include <numerics/fields.hpp>

namespace hyperlattice::numerics {

/// A symmetric matrix A, given only by its products. Some numbers of a field may not be unknowns;
/// their rows of A are zero.
class LinearOperator {
 public:
  LinearOperator() = default;
  virtual ~LinearOperator() = default;
  LinearOperator(const LinearOperator&) = delete;
  LinearOperator& operator=(const LinearOperator&) = delete;

  virtual std::size_t numbers() const = 0;  ///< numbers of a field: rows of A
  virtual int threads() const = 0;          ///< threads for arithmetic on fields
  /// Computes y = A x, with 0 for numbers that are not unknowns.
  virtual void multiply(const double* x, double* y) const = 0;
  /// Sets numbers that are not unknowns to zero.
  virtual void mask(double* x) const = 0;
};

class Preconditioner {
 public:
  Preconditioner() = default;
  virtual ~Preconditioner() = default;
  Preconditioner(const Preconditioner&) = delete;
  Preconditioner& operator=(const Preconditioner&) = delete;

  virtual void apply(const Field& r, Field& z) = 0;  ///< computes z, about A^-1 r
};

/// A subspace that solutions must be orthogonal to, usually the null space of A.
class Deflation {
 public:
  Deflation() = default;
  virtual ~Deflation() = default;
  Deflation(const Deflation&) = delete;
  Deflation& operator=(const Deflation&) = delete;

  virtual void remove_from(Field& field) const = 0;  ///< projects onto the orthogonal complement
};

}  // namespace hyperlattice::numerics
