// The state: displacements, velocities and alive springs, in blocks of planes with ghost planes,
// one block a thread.
#pragma once

#include <model/model.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace hyperlattice {

class Archive;

/// A base spring that broke. Its cross springs went with it.
struct Breakage {
  std::uint64_t step = 0;
  double time = 0;        ///< s
  Particle a = 0, b = 0;  ///< a stands first in the order z, y, x
  std::uint32_t neighbour = 0;
  double elongation = 0;  ///< when it broke, m
};

struct EnergyBalance {
  double kinetic = 0, kinetic_mean = 0, stored = 0, injected = 0, dissipated_failure = 0,
         dissipated_damping = 0;  ///< J
  Vec3 momentum;                  ///< N s
  double dissipated() const { return dissipated_failure + dissipated_damping; }
  double error = 0;  ///< J: kinetic + stored + dissipated - injected - what the start had
  double scale =
      0;  ///< J: the largest so far of each kind of energy, and of the works without their signs
  double relative_error() const { return scale > 0 ? error / scale : 0; }
};

/// A change from one state of rest to the next that no time step made. Fields are of particles, x y
/// z each, and heights where there are any.
struct EquilibriumUpdate {
  double time = 0;                   ///< afterwards, s
  std::vector<double> xyz, heights;  ///< displacements afterwards, m
  std::vector<double> force,
      force_before;  ///< of the springs on the particles, afterwards and before, N
  std::vector<double> factor, factor_before;  ///< of each load
  double gravity = 1, gravity_before = 1;     ///< shares of the body accelerations
  double dissipated = 0;                      ///< J, by what held the state before in place
};

/// The moving body. The same bits come out for any number of threads.
class Simulation {
 public:
  Simulation(const Model& model, int threads);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Of the steps that follow: alpha of local damping, and the rate of damping in proportion to
  /// mass, 1/s.
  void set_damping(double alpha, double rate = 0);
  /// Advances time. A step of another length than the one before costs an evaluation of all springs
  /// more. RunError if a load is not a number.
  void step(double time_step);
  double time() const;
  void set_time(double time);
  /// While held, steps do not advance time and loads act as they do at that time; what they drive
  /// goes where it would have come by then. If time is held already, as after a restart, it stays
  /// so.
  void hold_time(double time);
  void release_time();
  void halt();  ///< stops all motion; its kinetic energy counts as dissipated
  void apply_equilibrium(const EquilibriumUpdate& settling);  ///< halts, and counts as a step
  void reset_energy_balance();  ///< what is missing in the balance up to now is forgotten
  std::uint64_t steps() const;

  double kinetic() const;   ///< J, of the velocities v(n-1/2) as they are; costs little
  EnergyBalance balance();  ///< of the present state; one extra sweep that changes nothing
  std::vector<double> injected_by_load();  ///< J, one a load; up to the present state
  /// N, one a load: what acts on the particles that the load moves, along the axes that it
  /// prescribes, in the present state. At rest, the force with which the body pushes the load. One
  /// extra sweep that changes nothing.
  std::vector<Vec3> force_on_load();

  const std::vector<Breakage>& breakages() const;
  double elongation_now(
      std::size_t breakage) const;  ///< m, of a spring that is gone: open if above 0, closed if not
  std::uint64_t broken_open() const;  ///< how many are open; the others are closed

  /// Copies of a quantity, particles in the order z, y, x. Height is empty without a membrane.
  void displacements(std::vector<double>& xyz) const;
  void displacements(std::vector<double>& xyz, Particle first,
                     std::uint64_t count) const;    ///< of the particles from `first` on
  void velocities(std::vector<double>& xyz) const;  ///< v(n-1/2)
  void heights(std::vector<double>& values) const;
  void alive(std::vector<std::uint16_t>& bits)
      const;  ///< springs that each particle's site begins, see KernelRequest::alive
  void height_rates(std::vector<double>& values) const;
  /// Sets the state of every particle; for tests and for stages that start from another state.
  void set_displacements(const std::vector<double>& xyz, const std::vector<double>& heights);
  void set_velocities(const std::vector<double>& xyz, const std::vector<double>& height_rates);

  /// The particle that moves fastest, and whether every number is finite; for messages of a run
  /// that went bad.
  Particle fastest(double& speed, bool& finite) const;
  double farthest() const;  ///< m, of a particle from where it started
  std::uint64_t hash()
      const;  ///< FNV-1a over displacements, velocities and alive springs, in the particles' order
  double bytes() const;  ///< of the state, without scratch
  double scratch_bytes() const;
  void archive(Archive& archive);  ///< all of it; restored in a simulation of the same model and
                                   ///< number of threads, it goes on with the same bits

 private:
  struct Parts;
  struct Quantity {
    bool velocity;
    int first, components;
  };
  void copy(const Quantity& quantity, std::vector<double>& values) const;
  void copy(const Quantity& quantity, Particle first, std::uint64_t count,
            std::vector<double>& values) const;
  void set(const Quantity& quantity, const std::vector<double>& values);

  std::unique_ptr<Parts> parts_;
};

}  // namespace hyperlattice
