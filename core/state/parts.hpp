// The implementation of Simulation: its blocks and its energy balance. Its functions are in
// build.cpp, acting.cpp, step.cpp, start.cpp, equilibrium.cpp, breakage.cpp, balance.cpp and
// restart.cpp.
#pragma once

#include <model/arithmetic.hpp>
#include <process/team.hpp>
#include <state/block.hpp>
#include <state/simulation.hpp>

#include <array>
#include <utility>
#include <vector>

namespace hyperlattice {

inline double component(Vec3 v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

inline void set_component(Vec3& v, int c, double value) {
  (c == 0 ? v.x : c == 1 ? v.y : v.z) = value;
}

/// Returns the vector with its components along all other axes set to zero.
inline Vec3 along(Axes axes, Vec3 v) {
  return {(axes & 1u) != 0 ? v.x : 0, (axes & 2u) != 0 ? v.y : 0, (axes & 4u) != 0 ? v.z : 0};
}

/// One evaluation of all forces at the present time, and its purpose.
struct Sweep {
  /// The time, s, before and after the present time over which the forces act. Loads act by their
  /// mean over this interval.
  double before = 0, after = 0;
  /// The length, s, of the step in which prescribed particles move. 0: they have the limit of their
  /// velocity from before the present time.
  double step = 0;
  /// Half the duration, s, of the kick that a measurement computes from the acceleration.
  double measured = 0;
};

struct Simulation::Parts {
  const Model& model;
  std::unique_ptr<Layout> layout;
  std::vector<Block> blocks;
  std::vector<double> particle_masses;  ///< kg; filled when first asked for
  mutable Team team;  ///< threads; reading the state in parallel does not change it

  /// A load during a sweep, and the motion that it watches.
  struct Acting {
    double mean = 0;          ///< of the load factor over the sweep's interval
    double next = 0;          ///< load factor at the step's end
    double mean_of_step = 0;  ///< of the load factor from the present time to the step's end
    Load::Limit now;          ///< of the load factor at the present time
    bool moves = false;       ///< whether the load prescribes motion
    std::vector<Vec3> displacement, velocity;
    WatchedMotion motion;
  };
  std::vector<Acting> acting;  ///< one per load
  bool prepares = false;       ///< whether some load prepares its answers
  const bool exact = asked_for_exact_springs();

  double damping = 0, damping_rate = 0, last_step = 0;
  double time = 0, time_rest = 0;  ///< s, with the rest of a compensated sum
  double advanced = 0;             ///< by how much the last step advanced the time, s
  bool time_held = false;
  std::uint64_t steps = 0;
  std::vector<Breakage> breakages;
  struct Ends {
    const Block *block_a, *block_b;
    std::uint64_t a, b;
  };
  std::vector<Ends> ends;     ///< storage of the particles of each breakage
  double failure_energy = 0;  ///< dissipated by failure since the start, J
  double softened_energy = 0;  ///< lost in softening during equilibrium updates, J
  double halted_energy = 0;   ///< dissipated where motion was stopped or an equilibrium applied, J
  /// Work, J, that body accelerations would have done in addition, had they acted in full during
  /// equilibrium updates.
  double gravity_unused = 0;
  bool start_known = false;
  double start_energy = 0, start_potential = 0, largest_energy = 0;  ///< J

  Parts(const Model& model, int threads);

  // build.cpp
  void allocate(Block& block, std::size_t number) const;
  void add_supports(Block& block) const;

  // acting.cpp
  void prepare_loads(const Sweep& sweep);
  void watch(const Block& block);
  void prepare_answers();
  void prepare_supports(Block& block, const Sweep& sweep) const;
  void apply_forces(Block& block) const;
  double prescribed_velocity(const Block& block, const Contribution& part, int axis,
                             const Sweep& sweep) const;
  void check_factors() const;
  void check_answers() const;

  // step.cpp
  void step(double dt);
  /// Calls a kernel for a block.
  void run_kernel(decltype(KernelSet::step) kernel, Block& block, double back, double forward,
            bool measuring);
  KernelRequest request_for(Block& block, double back, double forward) const;

  // other_rows.cpp
  void compute_other_row(Block& block, const KernelRequest& request, const RowPlace& row,
                         bool measuring) const;
  RowEnergies several_laws_of_grid(Block& block, const KernelRequest& request,
                                   const RowPlace& row, bool measuring) const;
  RowEnergies several_laws_of_list(Block& block, const KernelRequest& request,
                                   const RowPlace& row, bool measuring) const;
  bool reaches_alarm(const SpringProperties& properties, double alarm, double elongation,
                     const Layout::Memory& memory) const;
  void receive_gone(Block& block, const AlarmRow& springs) const;

  // law_memory.cpp
  double elongation_of(const SpringProperties& properties, std::size_t cross, const Vec3& d,
                       double height_difference, double height_sum) const;
  void advance_laws(const EquilibriumUpdate& to);

  // start.cpp
  void start_prescribed(double dt);
  void change_step(double dt);

  // breakage.cpp
  const std::uint8_t* review(Block& block, const AlarmRow& alarm) const;
  void ask(Block& block, const AlarmRow& alarm, const Material::Criterion& criterion,
           const SpringFacts& facts, std::size_t first, std::span<const double> elongation) const;
  double rate_of(const Block& block, const AlarmRow& alarm, std::size_t n) const;
  using SpringMemory = std::array<double, max_spring_memory>;
  /// Returns the law's memory of a spring, which a kernel names by its place.
  SpringMemory memory_of(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                         std::int32_t site, std::size_t cross) const;
  void collect_breakages(double dt);
  void note_ends(const Breakage& breakage);
  double energy_of(std::size_t breakage, const Block& block, const Block::Broken& broken,
                   double dt) const;
  double elongation_now(std::size_t breakage) const;

  // balance.cpp
  RowSums measure(const Sweep& sweep);
  RowSums measure_now() { return measure({last_step / 2, 0, 0, last_step / 2}); }
  void find_start();
  std::vector<double> work_by_load(double potential) const;
  double gross_work(double potential) const;
  EnergyBalance balance();

  std::pair<const Block*, std::uint64_t> at(Particle particle) const {
    const Place place = layout->place(particle);
    return {&blocks[place.block], place.index};
  }
  /// Calls visit(block, index, first particle, count) for all particles in their order.
  template <class Visit>
  void for_runs(const Visit& visit) const {
    layout->for_stretches([&](const Stretch& stretch) {
      visit(blocks[stretch.block], stretch.index, stretch.first, stretch.count);
    });
  }
};

}  // namespace hyperlattice
