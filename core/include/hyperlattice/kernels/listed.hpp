// One pass over a block of a listed lattice: each particle sums the forces of all its springs, then moves. A vector holds eight particles that
// follow each other; its springs stand in slots, one of each particle in each. Neighbours are read from a copy of the displacements at the
// step's start, so that the particles may move as the pass reaches them, and no sum depends on where the body is cut into blocks.
#pragma once

#include <hyperlattice/kernels/springs.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

template <class Law, Membrane membrane, bool Breakable, bool Mixed, Task task>
class ListedSweep {
  static constexpr int components = components_of(membrane);
  static constexpr bool measuring = task == Task::measure;

 public:
  static void run(const KernelRequest& request) noexcept {
    const ListedSweep sweep(request);
    if (request.listed.stiffness != nullptr)
      sweep.template all_rows<true>();
    else
      sweep.template all_rows<false>();
  }

 private:
  explicit ListedSweep(const KernelRequest& request) : request_(request), slots_(request.listed) {}

  /// Several: each spring has a stiffness of its own.
  template <bool Several>
  void all_rows() const {
    for (std::uint32_t index = 0; index < static_cast<std::uint32_t>(request_.rows_per_plane); ++index) {
      const Row& row = request_.rows[index];
      Motion<membrane, Mixed, task, double> motion(request_, row);
      double* forces[components];
      for (int c = 0; c < components; ++c) {
        forces[c] = static_cast<double*>(request_.scratch) + c * request_.scratch_width;
        for (int t = 0; t < row.end; t += lanes) store(forces[c] + t, motion.accelerated() ? motion.body_force(c, t) : Pack{});
      }
      Pack stored{};
      for (int t = 0; t < row.end; t += lanes) one_vector<Several>(row, index, t, forces, stored);
      motion.vectors(forces);
      motion.finish(index, {0.5 * stored, 0});  // half of every spring's energy to each of its ends
    }
  }

  template <bool Several>
  void one_vector(const Row& row, std::uint32_t index, int t, double* const (&forces)[components], Pack& stored) const {
    Pack here[4] = {}, force[components];
    for (int c = 0; c < components; ++c) {
      here[c] = load(static_cast<const double*>(request_.displacement[c]) + row.start + t);
      force[c] = load(forces[c] + t);
    }
    const std::uint64_t vector = (row.start + static_cast<std::uint64_t>(t)) / lanes;
    for (std::uint32_t slot = slots_.first[vector]; slot < slots_.first[vector + 1]; ++slot) {
      const LanesOf<double> alive = lanes_of_byte(slots_.alive[slot]);
      Pack there[4] = {};
      gather(slot, there);
      const double* rest = slots_.rest + 4 * lanes * std::size_t{slot};
      const Pack rest_x = load(rest), rest_y = load(rest + lanes), rest_z = load(rest + 2 * lanes), rest_length = load(rest + 3 * lanes);
      const Pack dx = there[0] - here[0], dy = there[1] - here[1], dz = there[2] - here[2];
      const Pack q = dx * (2 * rest_x + dx) + dy * (2 * rest_y + dy) + dz * (2 * rest_z + dz);
      const double* stiffness = slots_.stiffness + 2 * lanes * std::size_t{slot};
      const Pack base_stiffness = Several ? load(stiffness) : fill(request_.springs->stiffness);

      Pack growth = q, difference{}, total{};  // the latter of the heights
      if constexpr (membrane == Membrane::free) {
        difference = there[3] - here[3];
        total = there[3] + here[3];
        growth += difference * difference;
      }
      const Response base = respond<Law, measuring>(base_stiffness, rest_length, growth);
      const Pack base_pull = where(alive, base.force_over_length);
      Pack pull = base_pull;
      if constexpr (measuring) stored += where(alive, base.energy);
      if constexpr (membrane != Membrane::none) {
        const double delta = request_.membrane_distance;
        const Pack cross_stiffness = Several ? load(stiffness + lanes) : fill(request_.springs->cross_stiffness);
        const Response cross =
            respond<Law, measuring>(cross_stiffness, root(rest_length * rest_length + delta * delta), q + total * (2 * delta + total));
        const Pack cross_pull = where(alive, cross.force_over_length);
        pull += cross_pull;
        if constexpr (measuring) stored += where(alive, cross.energy);
        if constexpr (membrane == Membrane::free) force[3] += base_pull * difference - cross_pull * (delta + total);
      }
      force[0] += pull * (rest_x + dx);
      force[1] += pull * (rest_y + dy);
      force[2] += pull * (rest_z + dz);
      if constexpr (Breakable && !measuring) review(index, t, slot, rest_length, growth);
    }
    for (int c = 0; c < components; ++c) store(forces[c] + t, force[c]);
  }

  /// Displacements of the slot's other ends.
  void gather(std::uint32_t slot, Pack (&there)[4]) const {
    const std::uint32_t* neighbour = slots_.neighbour + lanes * std::size_t{slot};
    alignas(64) double values[4][lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const double* from = slots_.around + 4 * std::size_t{neighbour[lane]};
      for (int c = 0; c < components; ++c) values[c][lane] = from[c];
    }
    for (int c = 0; c < components; ++c) there[c] = load(values[c]);
  }

  /// Asks the failure criterion about the slot's springs above their alarm, and removes those that broke. Each end of a spring asks and finds the
  /// same, because it sees the same numbers but for their signs.
  void review(std::uint32_t row, int t, std::uint32_t slot, const Pack& rest_length, const Pack& growth) const {
    const double* alarm = slots_.alarm + lanes * std::size_t{slot};
    double elongation[lanes];
    store(elongation, growth / (root(rest_length * rest_length + growth) + rest_length));
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(elongation[lane] > alarm[lane]) || (slots_.alive[slot] >> lane & 1) == 0) continue;
      const std::int32_t site = t + lane;
      const std::uint8_t* broken = request_.review(request_.self, {row, slot, {&site, 1}, {&elongation[lane], 1}});
      if (*broken != 0) slots_.alive[slot] = static_cast<std::uint8_t>(slots_.alive[slot] & ~(1U << lane));
    }
  }

  const KernelRequest& request_;
  const ListedSlots& slots_;
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
