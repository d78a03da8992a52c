// The state of a run: displacements, velocities and living springs, in one block per thread.
#pragma once

#include <model/model.hpp>
#include <ranks/ranks.hpp>
#include <state/breakage.hpp>
#include <state/crack_surface.hpp>
#include <state/energy_balance.hpp>
#include <state/equilibrium_update.hpp>
#include <state/layout.hpp>
#include <state/weakened_spring.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace hyperlattice {

class Archive;
class ForceSums;
struct DamageBounds;
struct SettledDamage;
struct SoftCell;
struct SoftParticle;
struct SoftSpring;
class Team;

/// The moving body. Results have the same bits for any number of threads and ranks. All ranks must
/// call the same functions in the same order, except while one acts alone (Ranks::Solo).
class Simulation {
 public:
  Simulation(const Model& model, int threads);
  /// Stores the body in so many blocks, at most one per plane of a grid, which the ranks share.
  Simulation(const Model& model, int threads, Ranks& ranks, int blocks);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Sets the damping of the steps that follow: `alpha` of local damping and the rate of damping in
  /// proportion to mass, 1/s.
  void set_damping(double alpha, double rate = 0);
  /// Returns whether steps are damped now.
  bool damps() const;
  /// Lets the particles whose own stable step is below `time_step`, s, take `parts` steps within
  /// each step that follows (local_steps.hpp); `parts` 1: none do.
  void set_local_steps(double time_step, std::int64_t parts);
  /// Gives particles added mass so that the critical step is at least `time_step`, s, in each step
  /// that follows (added_mass.hpp); 0: none.
  void set_added_mass(double time_step);
  /// Returns the mass of a particle with its added mass, kg.
  double inertia(Particle particle) const;
  /// Advances the body by a time step, s. A step of another length than the one before costs one
  /// more evaluation of all springs. Throws RunError if a load is not a number.
  void step(double time_step);
  /// Returns the threads of the run. They are idle between the calls of this class.
  Team& team() const;
  double time() const;
  void set_time(double time);
  /// Holds the time at `time`, s: steps then do not advance it, and loads act as they do at that
  /// time. Driven particles go to the place where they would have been by then. Does nothing if the
  /// time is held already, as after a restart.
  void hold_time(double time);
  void release_time();
  /// Stops all motion. Its kinetic energy counts as dissipated.
  void halt();
  /// Stops all motion and takes over the update's state; or takes over the end of an implicit step
  /// in time. Springs that failure criteria break there are removed. Counts as one step. Returns
  /// the largest growth of damage after an implicit step, which acts from the next one on.
  double apply_equilibrium(const EquilibriumUpdate& to);
  /// Returns how far the state after an update is beyond the first failure: the largest fraction by
  /// which all elongations could be smaller and some spring would still break; negative if none
  /// breaks. The state stays. Reads only times, displacements, heights and velocities.
  double overshoot(const EquilibriumUpdate& to);
  /// Prepares the first implicit step, of `time_step` seconds, after explicit steps or from rest.
  /// `velocity`, m/s, of all particles at the time of the displacements: only after explicit steps,
  /// whose velocities are those of half a step before.
  void begin_implicit_steps(double time_step, const std::vector<double>& velocity,
                            const std::vector<double>& height_rate);
  /// Sets the present error of the balance to zero.
  void reset_energy_balance();
  std::uint64_t steps() const;
  /// Returns the length of the last step, s; 0 if the next step starts from rest.
  double last_step() const;
  /// Calls work(n) for each n below `size` on the threads of the run, as Team::for_each does.
  void in_parallel(std::size_t size, const std::function<void(std::size_t)>& work) const;

  /// Brings the whole state up to date in every rank, or in the first one.
  void gather() const;
  void gather_in_first() const;

  /// Returns the kinetic energy, J, of the velocities v(n-1/2). Costs little.
  double kinetic() const;
  /// Returns the balance of the present state. Costs one extra sweep that changes nothing.
  EnergyBalance balance();
  /// Returns the work of each load up to the present state, J. Costs one extra sweep.
  std::vector<double> injected_by_load();
  /// Returns the work of each load, J, that the last balance() has counted.
  const std::vector<double>& work_of_loads() const;
  /// Returns for each load the force, N, on the particles that it moves, along the axes that it
  /// prescribes, in the present state. At rest it is the force with which the body pushes the load.
  /// Costs one extra sweep that changes nothing.
  std::vector<Vec3> force_on_load();
  /// Gives the force on every particle, N.
  using ForcesOnAll = std::function<const std::vector<Vec3>&()>;
  /// Returns the force of the loads on every particle, N, in the present state. `internal` gives
  /// the forces of the springs; it is called only if a load prescribes motion.
  std::vector<Vec3> external_forces(const ForcesOnAll& internal) const;
  /// Returns the numbers that a load keeps from one step to the next.
  std::span<double> load_memory(std::size_t load);
  /// Returns the sums of forces that probes follow.
  ForceSums& force_sums();

  /// Returns the failures in the order of their steps.
  const std::vector<Breakage>& breakages() const;
  /// Returns the present elongation, m, of a broken spring: above 0 if the failure is open.
  double elongation_now(std::size_t breakage) const;
  /// Returns the number of open failures; all others are closed.
  std::uint64_t broken_open() const;
  /// Returns the number of springs that failed, open and closed.
  std::uint64_t broken() const;

  /// Copy a quantity of all particles in the order z, y, x. Heights are empty without a membrane.
  void displacements(std::vector<double>& xyz) const;
  /// Copies the displacements of `count` particles from `first` on to the first rank, without the
  /// rest of the state. Returns whether this is that rank.
  bool displacements_in_first(std::vector<double>& xyz, Particle first, std::uint64_t count) const;
  enum class Motion : std::uint8_t { displacement, velocity, height };
  /// Copies such numbers of all particles to the first rank, in pieces: no rank gets the rest of
  /// the state. `values` is as of displacements(), velocities() or heights(); empty in other ranks.
  void copy_to_first(Motion what, std::vector<double>& values) const;
  void velocities(std::vector<double>& xyz) const;  ///< v(n-1/2), m/s
  void heights(std::vector<double>& values) const;
  /// Displacement or velocity of all particles in their order, where it is one array in memory.
  struct WholeMotion {
    const void* first = nullptr;  ///< x of the first particle, m or m/s, in the run's precision
    /// distance from x to y, z and, in a free membrane, the height
    std::size_t component_stride = 0;
  };
  /// Returns the array if the body is in one block whose rows follow each other without gaps; a
  /// null `first` otherwise. Later steps change the numbers.
  WholeMotion whole_motion(bool velocity) const;
  /// Copies the bits of the springs that start at each particle's site: see KernelRequest::alive.
  void alive(std::vector<std::uint16_t>& bits) const;
  void height_rates(std::vector<double>& values) const;
  /// Returns the memory of the law of the spring that starts at a particle of a structured body.
  Layout::Memory law_memory(Particle particle, std::uint32_t neighbour, bool cross) const;
  /// The memory of a spring of a listed body: of the base and of the cross spring.
  struct SpringMemory {
    std::uint32_t index = 0;  ///< in the body's list
    Layout::Memory of[2];
  };
  void for_springs_of_list(const std::function<void(const SpringMemory&)>& visit) const;
  /// Returns the springs that exist and whose integrity is below 1: those that their law softens,
  /// and then the soft springs of damage, whose integrity is what remains of them in tension.
  std::vector<WeakenedSpring> weakened_springs() const;
  /// Sets the damage of the particles of cohesive materials, and leaves the others' values.
  void copy_damage(std::vector<double>& values) const;
  /// Compute the fields crack_opening, m, and crack_time, s, of all particles; 0 and NaN where no
  /// material is cohesive.
  void crack_openings(std::vector<double>& values) const;
  void crack_times(std::vector<double>& values) const;
  /// Returns the springs whose stiffness damage lowers, in the order of their ends.
  std::vector<SoftSpring> soft_springs() const;
  std::vector<SoftParticle> soft_particles() const;
  std::vector<SoftCell> soft_cells() const;
  /// Returns the energy and the area of the cracks of cohesive materials.
  CrackSurface crack_surface() const;
  /// Finds the damage at rest for displacements other than the present ones (damage_field.hpp).
  /// The state stays; apply_equilibrium() takes the damage over.
  SettledDamage settle_damage(const std::vector<double>& xyz, const std::vector<double>& heights,
                              const DamageBounds& bounds);
  /// Forgets the damage that was found.
  void forget_damage_search();
  /// Computes a field that laws give: the mean over each particle's base springs, which count by
  /// their share; not a number where no spring has the field.
  void law_field(std::string_view name, std::vector<double>& values) const;
  /// Set the state of all particles, for tests and for stages that start from another state.
  void set_displacements(const std::vector<double>& xyz, const std::vector<double>& heights);
  void set_velocities(const std::vector<double>& xyz, const std::vector<double>& height_rates);

  /// Returns the fastest particle and its speed, m/s; or, with `finite` false, the first particle
  /// whose velocity is not finite. For the messages of failed runs.
  Particle fastest(double& speed, bool& finite) const;
  /// Returns the largest distance of a particle from its start, m.
  double farthest() const;
  /// Returns a hash of displacements, velocities and living springs, of damage and of what loads
  /// keep: the sum, modulo 2^64, of FNV-1a hashes of each particle with its number, and of the
  /// rest.
  std::uint64_t hash() const;
  double bytes() const;  ///< of the state without scratch arrays
  double scratch_bytes() const;
  /// Saves or restores the whole state. A simulation of the same model and number of threads
  /// continues with the same bits. All ranks restore, after prepare_to_save() the first one saves.
  void archive(Archive& archive);
  /// Saves or restores the state of the body without its loads, as the start of a run under other
  /// loads: their work and memory begin anew, and so does the energy balance. Time, number of steps
  /// and dissipated energies go on. A simulation of the same body, laws and number of blocks reads
  /// it. Throws std::runtime_error if the body is another one.
  void archive_body(Archive& archive);
  /// Prepares all ranks for a state that is saved.
  void prepare_to_save() const;
  /// Passes the state of this rank to the first one, in pieces, while that rank saves. All other
  /// ranks must call it.
  void pass_to_first();

 private:
  struct State;
  State& whole() const;
  struct Quantity {
    bool velocity;
    int first, components;
  };
  void copy(const Quantity& quantity, std::vector<double>& values) const;
  void copy(const Quantity& quantity, Particle first, std::uint64_t count, double* values) const;
  void set(const Quantity& quantity, const std::vector<double>& values);
  class OtherMotion;
  void set_motion(const EquilibriumUpdate& to);

  std::unique_ptr<State> state_;
};

}  // namespace hyperlattice
