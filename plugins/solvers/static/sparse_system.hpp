// A listed lattice: the tangent assembled, in blocks of a particle and a neighbour each, and factorised: whole if the body is small, else without the
// entries that the tangent does not have.
#pragma once

#include "spring_tangent.hpp"
#include "system.hpp"

#include <memory>

namespace hyperlattice::statics {

enum class Factorisation : std::uint32_t { automatic, whole, incomplete };

class SparseSystem : public System {
 public:
  SparseSystem(const StaticProblem& problem, Factorisation factorisation);
  ~SparseSystem() override;

  double linearise(const Field& displacement, Field& force) override;
  void multiply(const double* x, double* y) const override;
  void mask(double* x) const override;
  void prepare() override;
  void apply(const Field& r, Field& z) override;
  double stiffest() const override;
  int most_iterations() const override { return 20000; }
  void for_springs(const Join& join) const override;

 private:
  void find_pattern();
  SpringNumbers numbers(std::size_t spring) const;
  void assemble(const Field& displacement);
  double* block(std::size_t at) { return blocks_.data() + at * block_size_; }
  const double* block(std::size_t at) const { return blocks_.data() + at * block_size_; }
  std::size_t find(std::int64_t row, std::int64_t column) const;

  const StaticGrid& grid_;
  Factorisation factorisation_;
  std::size_t components_, block_size_;
  std::vector<std::size_t> first_;    ///< of each particle, where its blocks begin; one more entry at the end
  std::vector<std::int64_t> column_;  ///< of each block, ascending in a row; a particle's own among them
  Field blocks_;                      ///< row by row, N/m
  Floats axial_, pull_, cross_axial_, cross_pull_, alpha_;
  std::vector<std::size_t> free_;  ///< numbers of a field that can move and have stiffness, by particle and component
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace hyperlattice::statics
