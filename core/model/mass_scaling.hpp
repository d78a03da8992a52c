// Mass that is added to particles so that explicit steps may be longer: the step of a stage is then
// no longer dictated by a few stiff or light particles.
//
// Central differences with steps H are stable if H^2/4 K < M. The stiffness matrix K has a bound
// with one number k for each particle (see stiffness_bounds()), so a particle needs the mass
//   H^2/4 (k + c) + H/2 d,
// with the bounds c and d of what loads answer to its displacement and velocity (load_bound.cpp).
// What it lacks is added (Olovsson, Simonsson and Unosson, Int. J. Numer. Meth. Engng 63 (2005)
// 1436-1445, call this conventional mass scaling).
#pragma once

#include <model/model.hpp>

#include <string>
#include <vector>

namespace hyperlattice {

/// Returns what a body must be for added mass that gives it the critical step `time_step`, s; or
/// nothing if it is so.
std::string objection_to_mass_scaling(const Model& model, double time_step);

/// Returns a number k for each particle, N/m, so that u.K.u is at most the sum of k u^2 for any
/// motion u: of a body of cells the sum of the cells' bounds; else the stiffest wave of the
/// particle's material, if it has springs that are all inside the material, and StiffnessBound of
/// its other springs.
std::vector<double> stiffness_bounds(const Model& model);

class MassScaling {
 public:
  struct Heavy {
    Particle particle = 0;
    double added = 0;  ///< kg
  };
  /// Finds the mass that the body needs for the critical step `time_step`, s. The body must have no
  /// objection.
  MassScaling(const Model& model, double time_step);

  double time_step() const { return time_step_; }  ///< s
  /// The particles that get mass, ascending.
  const std::vector<Heavy>& particles() const { return particles_; }
  double added() const { return added_; }  ///< kg
  /// Returns the added mass over the mass of the body.
  double share() const { return added_ / body_; }
  /// Returns the largest mass of a particle with its added mass over that without.
  double largest_ratio() const { return largest_ratio_; }

 private:
  double time_step_;
  std::vector<Heavy> particles_;
  double added_ = 0, body_ = 0, largest_ratio_ = 1;
};

}  // namespace hyperlattice
