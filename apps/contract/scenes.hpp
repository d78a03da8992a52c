// The small scenes that a component under test stands in, in millimetres, and what their bodies do.
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

/// The membrane that a body has whose material is not what is tested: springs of all kinds, a
/// Poisson ratio of 0.1.
inline constexpr const char* usual_membrane = "I-m";

/// Makes stages of the components around, and plans of stages.
class Scenes {
 public:
  Scenes(Host& host, const Surroundings& around) : host_(host), around_(around) {}

  /// A box of that many cells of the grid, 1 mm wide, its low corner at the origin.
  Json grid_box(int nx, int ny, int nz, const char* boundary = "particles") const;

  /// The same box of the list.
  Json listed_box(int nx, int ny, int nz) const;

  /// Of 10 GPa and 2500 kg/m3 with a membrane; none: with the Poisson ratio that the lattice has.
  Json material(const char* membrane = "none") const;

  /// The same, with springs that break at that elongation, m.
  Json brittle(const char* membrane, double limit) const;

  /// Leads a face along z that far, m, within 0.01 ms.
  Json platen(const char* face, double way) const;

  /// Plans a scene of these stages, stepped in time if there is no solver. InputError with the
  /// faults.
  std::unique_ptr<Plan> plan_of(const std::vector<Json>& stages, int threads = 1,
                                const char* precision = "double") const;

 private:
  Host& host_;
  const Surroundings& around_;
};

/// Numbers drawn evenly from [-amplitude, amplitude], the same in every run.
std::vector<double> noise(std::size_t count, double amplitude, std::uint64_t seed = 1);

/// What a body that starts with random velocities has come to.
struct Shaken {
  double largest_error = 0;  ///< of the energy balance, relative
  EnergyBalance balance;
  std::uint64_t hash = 0;
  bool is_finite() const {
    return std::isfinite(largest_error);
  }  ///< equal bits of what is no number prove nothing
};
struct Shaking {
  double speed = 1;      ///< largest component of a velocity at the start, m/s
  double step = 0.4;     ///< over the critical one
  double duration = 40;  ///< in critical steps
  int threads = 1;
  bool cut_off = false;  ///< half-way, and gone on with from its archive in another simulation
};
Shaken shake(const Model& model, const Shaking& how);

/// What is visited, as bytes, and back.
std::string saved(const std::function<void(Archive&)>& visit);
void restore(const std::string& bytes, const std::function<void(Archive&)>& visit);

/// The state of a simulation in another of the same model.
std::unique_ptr<Simulation> restarted(Simulation& simulation, const Model& model, int threads);

/// A body that nothing moves but the caller.
class Led {
 public:
  explicit Led(const Model& model) : model_(model), simulation_(model, 1) {}

  /// Puts all particles where they are told, heights at rest, one step after the last. The forces
  /// of the springs on them, x y z each, N.
  std::vector<double> forces(const std::vector<double>& displacements, double time_step);
  Simulation& simulation() { return simulation_; }

 private:
  const Model& model_;
  Simulation simulation_;
  double last_step_ = 0;
};

/// Makes `largest` the larger of itself and a number's size; infinite for ever after a value that
/// is no number, so that it passes no comparison.
void take_largest(double& largest, double value);
double largest(const std::vector<double>& values);  ///< size; infinite if one is no number
double distance(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace hyperlattice::contract
