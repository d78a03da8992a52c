// The longest stable step of each particle, for bodies whose stiff parts take several steps within
// one step of the rest (state/local_steps.hpp).
#pragma once

#include <model/model.hpp>

#include <hyperlattice/solver.hpp>

#include <string>
#include <vector>

namespace hyperlattice {

/// Returns what a body must be for local steps, or nothing if it is so.
std::string objection_to_local_steps(const Model& model);

class LocalLimits {
 public:
  /// The body must have no objection.
  explicit LocalLimits(const Model& model);

  /// Returns the stable step, s, of a particle whose neighbours are held, at least.
  double operator[](Particle particle) const { return steps_[particle]; }
  /// Divides the body into particles that take `parts` steps within one step of the others. With
  /// `parts` 0 the cheapest division is taken.
  LocalSteps divide(std::int64_t parts) const;

 private:
  std::uint64_t below(double step) const;

  std::vector<double> steps_, sorted_;  ///< s
};

}  // namespace hyperlattice
