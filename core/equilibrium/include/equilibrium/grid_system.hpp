// The system of a structured lattice: the tangent is not assembled but applied spring by spring,
// with geometric multigrid as preconditioner.
#pragma once

#include <equilibrium/spring_multigrid.hpp>
#include <equilibrium/system.hpp>

namespace hyperlattice::equilibrium {

class GridSystem : public System {
 public:
  explicit GridSystem(const StaticProblem& problem)
      : System(problem), matrix_(problem), multigrid_(matrix_) {}

  double linearise(const Field& displacement, Field& force) override {
    return matrix_.linearise(displacement, force);
  }
  void multiply(const double* x, double* y) const override { matrix_.multiply(x, y); }
  void mask(double* x) const override { matrix_.mask(x); }
  void prepare() override {
    if (!matrix_.is_new()) return;
    multigrid_.build();
    matrix_.prepared();
  }
  std::span<const double> made_from() const override { return matrix_.made_from(); }
  void make_again(std::span<const double> from) override {
    if (from.empty()) return;  // none was made
    matrix_.recall(from);
    multigrid_.build();
    matrix_.prepared();
  }
  void apply(const Field& r, Field& z) override { multigrid_.apply(r, z); }
  double stiffest() const override { return matrix_.stiffest(); }
  double softest_height() const override { return matrix_.softest_height(); }
  void for_springs(const Join& join) const override {
    const StaticGrid& grid = matrix_.grid();
    for (std::size_t n = 0; n < grid.neighbours.size(); ++n)
      for (std::int64_t place = grid.origin; place < grid.places; ++place)
        if (matrix_.has_spring(n, place))
          join(place, place + grid.step_to(grid.neighbours[n].site));
  }

 private:
  SpringLevel matrix_;
  SpringMultigrid multigrid_;
};

}  // namespace hyperlattice::equilibrium
