// The small scenes in which a component is tested (lengths of some millimetres), and measurements
// of the motion of their bodies.
#pragma once

#include <contract/contract.hpp>
#include <plan/plan.hpp>
#include <scene/json.hpp>
#include <state/archive.hpp>
#include <state/simulation.hpp>

#include <cmath>
#include <memory>
#include <vector>

namespace hyperlattice::contract {

/// The membrane of a body whose material is not under test: it has springs of all kinds and a
/// Poisson ratio of 0.1.
inline constexpr const char* usual_membrane = "I-m";

/// Makes stages from the components of `around`, and plans from stages.
class Scenes {
 public:
  Scenes(Host& host, const OtherComponents& around) : host_(host), around_(around) {}

  /// Returns a grid of nx x ny x nz cells 1 mm wide, with its low corner at the origin.
  Json grid_box(int nx, int ny, int nz, const char* boundary = "particles") const;

  /// Returns a lattice that is a list of springs, in the same box.
  Json listed_box(int nx, int ny, int nz) const;

  /// Returns a material of 10 GPa and 2500 kg/m3. With the membrane "none" it has the Poisson ratio
  /// of the lattice itself.
  Json material(const char* membrane = "none") const;

  /// Returns the same material with springs that break at the elongation `limit`, m.
  Json brittle(const char* membrane, double limit) const;

  /// Returns a load that moves a face by `way`, m, along z within 0.01 ms.
  Json platen(const char* face, double way) const;

  /// Plans a scene of these stages; adds a solver that steps in time if there is none. Throws
  /// InputError with all faults of the scene.
  std::unique_ptr<Plan> plan_of(const std::vector<Json>& stages, int threads = 1,
                                const char* precision = "double") const;

 private:
  Host& host_;
  const OtherComponents& around_;
};

/// Returns random numbers, uniform in [-amplitude, amplitude]; the same seed gives the same numbers
/// in every run.
std::vector<double> noise(std::size_t count, double amplitude, std::uint64_t seed = 1);

/// The result of the motion of a body from random start velocities.
struct MotionResult {
  double largest_error = 0;  ///< largest relative error of the energy balance
  EnergyBalance balance;
  std::uint64_t hash = 0;
  /// Equal hashes prove nothing if the energies are not finite.
  bool is_finite() const { return std::isfinite(largest_error); }
};
/// A motion from random start velocities.
struct RandomMotion {
  double speed = 1;      ///< largest component of a start velocity, m/s
  double step = 0.4;     ///< time step over the critical time step
  double duration = 40;  ///< in critical time steps
  int threads = 1;
  /// Continue half-way in another simulation, from the archive of the first one.
  bool cut_off = false;
};
MotionResult run_motion(const Model& model, const RandomMotion& motion);

/// saved() returns what `visit` archives as bytes; restore() reads it back from these bytes.
std::string saved(const std::function<void(Archive&)>& visit);
void restore(const std::string& bytes, const std::function<void(Archive&)>& visit);

/// Returns a new simulation of the same model with the state of `simulation`.
std::unique_ptr<Simulation> restarted(Simulation& simulation, const Model& model, int threads);

/// A body whose displacements the caller prescribes in each step.
class DrivenBody {
 public:
  explicit DrivenBody(const Model& model) : model_(model), simulation_(model, 1) {}

  /// Sets the displacements of all particles, m, with heights 0 and velocities 0, and takes one
  /// step of `time_step` seconds. Returns the forces of the springs on the particles, x y z each,
  /// N.
  std::vector<double> forces(const std::vector<double>& displacements, double time_step);
  Simulation& simulation() { return simulation_; }

 private:
  const Model& model_;
  Simulation simulation_;
  double last_step_ = 0;
};

/// Sets `largest` to the larger of itself and abs(value). A value that is not a number makes it
/// infinite for good, so that no later comparison passes.
void take_largest(double& largest, double value);
/// Returns the largest absolute value; infinite if a value is not a number.
double largest(const std::vector<double>& values);
/// Returns the largest absolute difference of two vectors of the same length.
double distance(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace hyperlattice::contract
