#include <equilibrium/stability.hpp>

#include <equilibrium/free_motions.hpp>

#include <numerics/random_stream.hpp>

namespace hyperlattice::equilibrium {

namespace {

/// Returns random numbers for all free components, the same in every run.
Field rough_field(const System& system) {
  const StaticGrid& grid = system.problem().grid;
  Field rough(grid.numbers(), 0);
  numerics::RandomStream random;
  for (std::int64_t p = 0; p < grid.places; ++p)
    for (int c = 0; c < grid.components; ++c) {
      if ((grid.free[p] >> c & 1u) == 0) continue;
      rough[static_cast<std::size_t>(c * grid.places + p)] = random.next();
    }
  return rough;
}

}  // namespace

Field softening_motion(System& system, numerics::ConjugateGradients& gradients,
                       const Field& displacement) {
  constexpr double solved = 1e-3, rounding = 1e-13;
  const auto softens = [&](const Field& motion, double curvature) {
    return curvature < -rounding * system.stiffest() *
                           product(motion.data(), motion.data(), motion.size(), system.threads());
  };
  const FreeMotions free(system, displacement);
  const Field rough = rough_field(system);
  gradients.start(rough, &free);
  const Field& left = gradients.residual();
  bool goes_on = true;
  for (int n = 0; goes_on && n < system.most_iterations(); ++n) {
    if (gradients.unit() * largest(left) <= solved) return {};
    goes_on = gradients.advance();
  }
  if (!goes_on && softens(gradients.direction(), gradients.curvature()))
    return gradients.direction();
  // The preconditioner does not act on components without stiffness, such as heights that have lost
  // theirs by compression: these remain in the residual.
  Field resisting(left.size());
  system.multiply(left.data(), resisting.data());
  return softens(left, product(left.data(), resisting.data(), left.size(), system.threads()))
             ? left
             : Field{};
}

}  // namespace hyperlattice::equilibrium
