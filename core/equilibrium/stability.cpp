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
  Field right = rough_field(system), resisting(right.size());
  const auto resisted = [&](const Field& motion) {
    system.multiply(motion.data(), resisting.data());
    return product(motion.data(), resisting.data(), motion.size(), system.threads());
  };
  bool goes_on = true;
  // A preconditioner that solves the equations, as it does for small bodies, hides negative
  // stiffness from the gradients. The solutions of a few inverse iterations then show it.
  constexpr int iterations = 4, few = 20;
  for (int i = 0; goes_on && i < iterations; ++i) {
    gradients.start(right, &free);
    int n = 0;
    for (; goes_on && n < system.most_iterations(); ++n) {
      if (gradients.unit() * largest(gradients.residual()) <= solved * largest(right)) break;
      goes_on = gradients.advance();
    }
    if (!goes_on || n == system.most_iterations()) break;
    const Field& motion = gradients.x();
    if (softens(motion, resisted(motion))) return motion;
    const double size = largest(motion);
    if (n > few || i + 1 == iterations || !(size > 0)) return {};
    for (std::size_t m = 0; m < right.size(); ++m) right[m] = motion[m] / size;
  }
  const Field& left = gradients.residual();
  if (!goes_on && softens(gradients.direction(), gradients.curvature()))
    return gradients.direction();
  // The preconditioner does not act on components without stiffness, such as heights that have lost
  // theirs by compression: these remain in the residual.
  return softens(left, resisted(left)) ? left : Field{};
}

}  // namespace hyperlattice::equilibrium
