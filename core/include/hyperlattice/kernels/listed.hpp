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
  explicit ListedSweep(const KernelRequest& request) : request_(request), slots_(request.listed), exact_(exact_springs()) {}

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

  /// Eight particles, or the other ends of eight springs: places at rest, displacements, heights.
  struct Eight {
    Pack rest[4], moved[4];
  };
  /// Eight springs from here to there.
  struct Reach {
    Pack rest[3], square;       ///< rest vector, and its square: 0 where there is no spring
    Pack d[3];                  ///< difference of displacements
    Pack growth, cross_growth;  ///< of the squared lengths
    Pack height_difference, height_sum;
  };
  struct Pulls {
    Pack base, cross;  ///< force over length
  };

  template <bool Several>
  void one_vector(const Row& row, std::uint32_t index, int t, double* const (&forces)[components], Pack& stored) const {
    const std::uint64_t start = row.start + static_cast<std::uint64_t>(t), vector = start / lanes;
    Pack force[components];
    for (int c = 0; c < components; ++c) force[c] = load(forces[c] + t);
    std::uint32_t own[lanes];
    for (std::uint32_t lane = 0; lane < lanes; ++lane) own[lane] = static_cast<std::uint32_t>(start) + lane;
    const Eight here = eight(own);
    for (std::uint32_t slot = slots_.first[vector]; slot < slots_.first[vector + 1]; ++slot) {
      const Reach reach = between(here, eight(slots_.neighbour + lanes * std::size_t{slot}));
      const double* stiffness = slots_.stiffness + 2 * lanes * std::size_t{slot};
      const Pack base_stiffness = Several ? load(stiffness) : fill(request_.springs->stiffness);
      const Pack cross_stiffness = membrane == Membrane::none ? Pack(0) : Several ? load(stiffness + lanes) : fill(request_.springs->cross_stiffness);
      const Pulls pulls = pulls_of(reach, base_stiffness, cross_stiffness, index, t, slot, stored);
      Pack pull = pulls.base;
      if constexpr (membrane != Membrane::none) pull += pulls.cross;
      if constexpr (membrane == Membrane::free)
        force[3] += pulls.base * reach.height_difference - pulls.cross * (request_.membrane_distance + reach.height_sum);
      each<3>([&]<std::size_t c>() __attribute__((always_inline)) { force[c] += pull * (reach.rest[c] + reach.d[c]); });
    }
    for (int c = 0; c < components; ++c) store(forces[c] + t, force[c]);
  }

  HYPERLATTICE_INLINE Eight eight(const std::uint32_t* places) const {
    const double *rest[lanes], *moved[lanes];
    each<lanes>([&]<std::size_t lane>() __attribute__((always_inline)) {
      rest[lane] = slots_.rest + 4 * std::size_t{places[lane]};
      moved[lane] = slots_.around + 4 * std::size_t{places[lane]};
    });
    Eight eight;
    load_records(rest, eight.rest);
    load_records(moved, eight.moved);
    return eight;
  }

  HYPERLATTICE_INLINE Reach between(const Eight& here, const Eight& there) const {
    Reach reach;
    reach.square = reach.growth = 0;
    each<3>([&]<std::size_t c>() __attribute__((always_inline)) {
      reach.rest[c] = there.rest[c] - here.rest[c];
      reach.d[c] = there.moved[c] - here.moved[c];
      reach.square += reach.rest[c] * reach.rest[c];
      reach.growth += reach.d[c] * (2 * reach.rest[c] + reach.d[c]);
    });
    reach.cross_growth = reach.growth;
    if constexpr (membrane == Membrane::free) {
      reach.height_difference = there.moved[3] - here.moved[3];
      reach.height_sum = there.moved[3] + here.moved[3];
      reach.growth += reach.height_difference * reach.height_difference;
      reach.cross_growth += reach.height_sum * (2 * request_.membrane_distance + reach.height_sum);
    }
    return reach;
  }

  HYPERLATTICE_INLINE Pulls pulls_of(const Reach& reach, const Pack& stiffness, const Pack& cross_stiffness, std::uint32_t row, int t,
                                     std::uint32_t slot, Pack& stored) const {
    constexpr double smallest = 1e-300;  // m2: where there is no spring
    Pulls pulls;
    if constexpr (!measuring && is_linear<Law>) {
      Outside<double> outside;
      const Pack p = reach.growth / (reach.square + smallest);
      outside.look(p, -Terms<double>::few.range, Terms<double>::few.range);
      Pack cross_p;
      if constexpr (membrane != Membrane::none) {
        cross_p = reach.cross_growth / (reach.square + request_.membrane_distance * request_.membrane_distance);
        outside.look(cross_p, -Terms<double>::few.range, Terms<double>::few.range);
      }
      if constexpr (Breakable) outside.look_above(reach.growth, load(slots_.alarm + lanes * std::size_t{slot}));
      if (!outside && !exact_) [[likely]] {
        pulls.base = pull_near_rest<Law>(stiffness, p);
        if constexpr (membrane != Membrane::none) pulls.cross = where(not_zero(reach.square), pull_near_rest<Law>(cross_stiffness, cross_p));
        return pulls;
      }
    }
    const Reach in_memory = reach;
    Pack stored_by_slot = 0;
    pulls = pulls_by_root(in_memory, stiffness, cross_stiffness, row, t, slot, stored_by_slot);
    if constexpr (measuring) stored += stored_by_slot;
    return pulls;
  }

  [[gnu::noinline]] Pulls pulls_by_root(const Reach& reach, const Pack& stiffness, const Pack& cross_stiffness, std::uint32_t row, int t,
                                        std::uint32_t slot, Pack& stored) const {
    const LanesOf<double> there_is = not_zero(reach.square);
    Pulls pulls;
    const Response base = respond<Law, measuring>(stiffness, root(reach.square), reach.growth);
    pulls.base = where(there_is, base.force_over_length);
    if constexpr (measuring) stored += where(there_is, base.energy);
    if constexpr (membrane != Membrane::none) {
      const double delta = request_.membrane_distance;
      const Response cross = respond<Law, measuring>(cross_stiffness, root(reach.square + delta * delta), reach.cross_growth);
      pulls.cross = where(there_is, cross.force_over_length);
      if constexpr (measuring) stored += where(there_is, cross.energy);
    }
    if constexpr (Breakable && !measuring) review(reach, row, t, slot);
    return pulls;
  }

  /// Asks the failure criterion about the slot's springs above their alarm, and removes those that broke. Each end of a spring asks and finds the
  /// same, because it sees the same numbers but for their signs.
  void review(const Reach& reach, std::uint32_t row, int t, std::uint32_t slot) const {
    const double* alarm = slots_.alarm + lanes * std::size_t{slot};
    std::uint32_t* neighbour = slots_.neighbour + lanes * std::size_t{slot};
    double growth[lanes], elongation[lanes];
    const Pack rest_length = root(reach.square);
    store(growth, reach.growth);
    store(elongation, reach.growth / (root(reach.square + reach.growth) + rest_length));
    for (int lane = 0; lane < lanes; ++lane) {
      const auto own = static_cast<std::uint32_t>(request_.rows[row].start) + static_cast<std::uint32_t>(t + lane);
      if (!(growth[lane] > alarm[lane]) || neighbour[lane] == own) continue;
      const std::int32_t site = t + lane;
      const std::uint8_t* broken = request_.review(request_.self, {row, slot, {&site, 1}, {&elongation[lane], 1}});
      if (*broken != 0) neighbour[lane] = own;
    }
  }

  const KernelRequest& request_;
  const ListedSlots& slots_;
  const bool exact_;
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
