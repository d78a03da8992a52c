// The inside of a Simulation: its blocks and its books. Split by concern: build.cpp, step.cpp, settle.cpp, breakage.cpp, balance.cpp.
#pragma once

#include <run/block.hpp>
#include <run/state.hpp>

#include <utility>
#include <vector>

namespace hyperlattice {

inline double component(Vec3 v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

struct Simulation::Parts {
  const Model& model;
  Layout layout;
  std::vector<Block> blocks;
  std::vector<double> masses, alphas;   ///< of each material
  std::vector<double> particle_masses;  ///< kg; filled when first asked for
  int threads = 1;

  double damping = 0, last_step = 0;
  double time = 0, time_rest = 0;  ///< compensated sum
  bool time_held = false;
  std::uint64_t steps = 0;
  std::vector<Breakage> breakages;
  struct Ends {
    const Block *block_a, *block_b;
    std::uint64_t a, b;
  };
  std::vector<Ends> ends;     ///< where the particles of each breakage are stored
  double failure_energy = 0;  ///< J, dissipated since the start
  double halted_energy = 0;   ///< J, dissipated where motion was stopped
  double gravity_unused = 0;  ///< J, work of body accelerations that did not act in full while the body settled
  bool start_known = false;
  double start_energy = 0, start_potential = 0, largest_energy = 0;  ///< J

  Parts(const Model& model, int threads);

  // build.cpp
  void allocate(Block& block, const BlockLayout& planned) const;
  void add_supports(Block& block) const;

  // step.cpp
  void step(double dt);
  KernelRequest request_for(Block& block, double back, double forward) const;
  void exchange(Block& block) const;
  void prepare_supports(Block& block, double step) const;
  void start(double step);

  // breakage.cpp
  const std::uint8_t* review(Block& block, const AlarmRow& alarm) const;
  void collect_breakages(double dt);
  double energy_of(std::size_t breakage, double dt) const;
  double elongation_now(std::size_t breakage) const;

  // balance.cpp
  RowSums measure(double back);
  void find_start();
  std::vector<double> work_by_load(double potential) const;
  Balance balance();

  // Where things are.
  bool owns(const Block& block, std::int32_t k) const { return k >= block.layout->first && k < block.layout->first + block.layout->planes; }
  Site first_site_of_row(const Block& block, std::size_t row) const {
    const auto rows = static_cast<std::size_t>(model.body.grid.sites[1]);
    return {block.rows[row].begin, static_cast<std::int32_t>(row % rows),
            block.layout->first - model.body.reach + static_cast<std::int32_t>(row / rows)};
  }
  std::size_t row_of(const Block& block, Site site) const {
    return static_cast<std::size_t>(site.k - block.layout->first + model.body.reach) * static_cast<std::size_t>(model.body.grid.sites[1]) +
           static_cast<std::size_t>(site.j);
  }
  std::uint64_t place_of(const Block& block, Site site) const {
    const Row& row = block.rows[row_of(block, site)];
    return row.start + static_cast<std::uint64_t>(site.i - row.begin);
  }
  std::pair<const Block*, std::uint64_t> at(Particle particle) const {
    const Site site = model.body.site(particle);
    const Block& block = blocks[layout.block_of_plane(site.k)];
    return {&block, place_of(block, site)};
  }
  /// Calls visit(block, place, first particle, count) for every run, in the particles' order.
  template <class Visit>
  void for_runs(const Visit& visit) const {
    for (const Run& run : model.body.runs) {
      const Block& block = blocks[layout.block_of_plane(run.k)];
      visit(block, place_of(block, {run.begin, run.j, run.k}), run.first, static_cast<std::uint64_t>(run.end - run.begin));
    }
  }
};

}  // namespace hyperlattice
