// One pass over a block of a listed lattice: each particle sums the forces of all its springs, then
// moves. A pack holds consecutive particles; its springs are in slots, each with one spring of each
// particle. Neighbours are read from records with the displacements at the start of the step. So
// particles may move when the pass reaches them, and sums do not depend on the cuts between blocks.
#pragma once

#include <hyperlattice/kernels/records.hpp>
#include <hyperlattice/kernels/springs.hpp>

#include <limits>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Computes the forces on particles from the records of the start of the step.
template <class Law, KernelConfig config>
class ListedForces {
  using Stored = NumberOf<config.stored>;
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  static constexpr Membrane membrane = config.membrane;
  static constexpr bool measuring = config.measures();
  static constexpr int components = config.components(), width = lanes_of<Real>,
                       slot_width = lanes_of<Stored>;

 public:
  explicit ListedForces(const KernelRequest& request) : request_(request), slots_(request.listed) {}

  [[gnu::noinline]] void write_records() const {
    for (std::int32_t index = 0; index < request_.rows_per_plane; ++index) {
      const Row& row = request_.rows[index];
      for (std::uint64_t n = row.start; n < row.start + static_cast<std::uint64_t>(row.end); ++n)
        for (std::size_t c = 0; c < components; ++c)
          record(n)[record_moved + c] = static_cast<const Stored*>(request_.displacement[c])[n];
    }
  }

  /// Adds the forces of a row's springs to those on its particles, one array for each component,
  /// and half of each spring's energies; the other end adds the other half. `index`: index of the
  /// row. Not inlined: all sweeps share it.
  [[gnu::noinline]] void add(const Row& row, std::uint32_t index, Real* const (&forces)[components],
                             Energies<Pack>& energies) const {
    if (slots_.stiffness != nullptr)
      all_packs<true>(row, index, forces, energies);
    else
      all_packs<false>(row, index, forces, energies);
    energies.stored *= 0.5;
    energies.dissipated *= 0.5;
    energies.fractured *= 0.5;
  }

 private:
  Stored* record(std::uint64_t place) const {
    return static_cast<Stored*>(slots_.records) + record_numbers * place;
  }

  /// Several: springs have different stiffnesses.
  template <bool Several>
  void all_packs(const Row& row, std::uint32_t index, Real* const (&forces)[components],
                 Energies<Pack>& energies) const {
    for (int t = 0; t < row.end; t += width) one_pack<Several>(row, index, t, forces, energies);
  }

  /// A pack of springs, from `here` to `there`.
  struct Reach {
    Pack rest[3], square;       ///< rest vector, m, and its square; 0 if there is no spring
    Pack d[3];                  ///< difference of displacements, m
    Pack growth, cross_growth;  ///< growth of the squared lengths, m2
    Pack height_difference, height_sum;
  };
  struct Pulls {
    Pack base, cross;  ///< force over length, N/m
  };
  /// Lanes of a slot. If the state is in floats, a computation in doubles takes half of them at a
  /// time.
  struct Slot {
    std::uint32_t row, number;
    int site;  ///< place of the first lane in the row
    std::size_t first_lane;
  };

  template <bool Several>
  HYPERLATTICE_INLINE void one_pack(const Row& row, std::uint32_t index, int t,
                                    Real* const (&forces)[components],
                                    Energies<Pack>& energies) const {
    const std::uint64_t start = row.start + static_cast<std::uint64_t>(t),
                        pack = start / slot_width;
    Pack force[components];
    for (int c = 0; c < components; ++c) force[c] = load(forces[c] + t);
    std::uint32_t own[width];
    for (std::uint32_t lane = 0; lane < width; ++lane)
      own[lane] = static_cast<std::uint32_t>(start) + lane;
    const Records<Real> here = records(own);
    for (std::uint32_t number = slots_.first[pack]; number < slots_.first[pack + 1]; ++number) {
      const Slot slot{index, number, t, slot_width * std::size_t{number} + start % slot_width};
      fetch(slots_.neighbour + slot.first_lane + slots_ahead * slot_width);
      const Reach reach = between(here, records(slots_.neighbour + slot.first_lane));
      const Pack base_stiffness =
          Several ? stiffness(slot, 0) : fill<Real>(request_.springs->stiffness);
      const Pack cross_stiffness = membrane == Membrane::none ? Pack(0)
                                   : Several                  ? stiffness(slot, 1)
                                             : fill<Real>(request_.springs->cross_stiffness);
      Pulls pulls;
      if constexpr (LawWithMemory<Law>)
        pulls =
            pulls_by_law(reach, base_stiffness, cross_stiffness, constants_of(row), slot, energies);
      else
        pulls = pulls_of(reach, base_stiffness, cross_stiffness, constants_of(row), slot,
                         energies.stored);
      Pack pull = pulls.base;
      if constexpr (membrane != Membrane::none) pull += pulls.cross;
      if constexpr (membrane == Membrane::free)
        force[3] += pulls.base * reach.height_difference -
                    pulls.cross * (request_.membrane_distance + reach.height_sum);
      each<3>([&]<std::size_t c>() __attribute__((always_inline)) {
        force[c] += pull * (reach.rest[c] + reach.d[c]);
      });
    }
    for (int c = 0; c < components; ++c) store(forces[c] + t, force[c]);
  }

  HYPERLATTICE_INLINE Pack stiffness(const Slot& slot, std::size_t cross) const {
    return load_as<Real>(static_cast<const Stored*>(slots_.stiffness) +
                         slot_width * (std::size_t{slot.number} + cross) + slot.first_lane);
  }
  HYPERLATTICE_INLINE const Stored* alarms(const Slot& slot) const {
    return static_cast<const Stored*>(slots_.alarm) + slot.first_lane;
  }

  HYPERLATTICE_INLINE Records<Real> records(const std::uint32_t* places) const {
    const Stored* all[width];
    each<width>([&]<std::size_t lane>()
                    __attribute__((always_inline)) { all[lane] = record(places[lane]); });
    return load_records_as<Real>(all);
  }

  /// Prefetches records: the processor cannot predict the addresses that a list leads to.
  HYPERLATTICE_INLINE void fetch(const std::uint32_t* places) const {
    each<width>([&]<std::size_t lane>()
                    __attribute__((always_inline)) { __builtin_prefetch(record(places[lane])); });
  }

  HYPERLATTICE_INLINE Reach between(const Records<Real>& here, const Records<Real>& there) const {
    Reach reach;
    reach.square = reach.growth = 0;
    each<3>([&]<std::size_t c>() __attribute__((always_inline)) {
      reach.rest[c] = there[c] - here[c];
      reach.d[c] = there[record_moved + c] - here[record_moved + c];
      reach.square += reach.rest[c] * reach.rest[c];
      reach.growth += reach.d[c] * (2 * reach.rest[c] + reach.d[c]);
    });
    reach.cross_growth = reach.growth;
    if constexpr (membrane == Membrane::free) {
      constexpr std::size_t height = record_moved + 3;
      reach.height_difference = there[height] - here[height];
      reach.height_sum = there[height] + here[height];
      reach.growth += reach.height_difference * reach.height_difference;
      reach.cross_growth += reach.height_sum * (2 * request_.membrane_distance + reach.height_sum);
    }
    return reach;
  }

  HYPERLATTICE_INLINE Pulls pulls_of(const Reach& reach, const Pack& stiffness,
                                     const Pack& cross_stiffness, const SpringConstants& constants,
                                     const Slot& slot, Pack& stored) const {
    constexpr Real smallest = std::numeric_limits<Real>::min();  // m2, for lanes without a spring
    Pulls pulls;
    if constexpr (!measuring && is_linear<Law>) {
      constexpr Real range = static_cast<Real>(Terms<Real>::few.range);
      Outside<Real> outside;
      const Pack p = reach.growth / (reach.square + smallest);
      outside.look(p, -range, range);
      Pack cross_p;
      if constexpr (membrane != Membrane::none) {
        cross_p = reach.cross_growth /
                  (reach.square + request_.membrane_distance * request_.membrane_distance);
        outside.look(cross_p, -range, range);
      }
      if (slots_.alarm != nullptr) outside.look_above(reach.growth, load(alarms(slot)));
      if (!outside && !request_.exact) [[likely]] {
        pulls.base = near_rest(stiffness, reach.square, p, constants.law[0]);
        if constexpr (membrane != Membrane::none)
          pulls.cross = where(
              not_zero(reach.square),
              near_rest(cross_stiffness,
                        reach.square + request_.membrane_distance * request_.membrane_distance,
                        cross_p, constants.law[1]));
        return pulls;
      }
    }
    const Reach in_memory = reach;
    Pack stored_by_slot = 0;
    pulls = pulls_by_root(in_memory, stiffness, cross_stiffness, constants, slot, stored_by_slot);
    if constexpr (measuring) stored += stored_by_slot;
    return pulls;
  }

  /// `square`: of the rest length, m2; used by laws with constants only.
  HYPERLATTICE_INLINE static Pack near_rest(const Pack& stiffness, const Pack& square,
                                            const Pack& p, const double* constants) {
    return pull_near_rest<Law, Real>(stiffness, LawWithConstants<Law> ? root(square) : square, p,
                                     constants);
  }

  [[gnu::noinline]] Pulls pulls_by_root(const Reach& reach, const Pack& stiffness,
                                        const Pack& cross_stiffness,
                                        const SpringConstants& constants, const Slot& slot,
                                        Pack& stored) const {
    const LanesOf<Real> there_is = not_zero(reach.square);
    Pulls pulls;
    const ResponseOf<Pack> base =
        respond<Law, measuring>(stiffness, root(reach.square), reach.growth, constants.law[0]);
    pulls.base = where(there_is, base.force_over_length);
    if constexpr (measuring) stored += where(there_is, base.energy);
    if constexpr (membrane != Membrane::none) {
      const double delta = request_.membrane_distance;
      const ResponseOf<Pack> cross =
          respond<Law, measuring>(cross_stiffness, root(reach.square + delta * delta),
                                  reach.cross_growth, constants.law[1]);
      pulls.cross = where(there_is, cross.force_over_length);
      if constexpr (measuring) stored += where(there_is, cross.energy);
    }
    if (!measuring && slots_.alarm != nullptr) review(reach, slot);
    return pulls;
  }

  /// Computes the same for a law with a memory.
  [[gnu::noinline]] Pulls pulls_by_law(const Reach& reach, const Pack& stiffness,
                                       const Pack& cross_stiffness,
                                       const SpringConstants& constants, const Slot& slot,
                                       Energies<Pack>& energies) const {
    LawSprings springs;
    springs.time_step = 2 * request_.back;
    springs.memory_stride = slot_width;
    for (std::uint32_t lane = 0; lane < lanes; ++lane)
      if (slots_.neighbour[slot.first_lane + lane] != own_place(slot, lane))
        springs.there |= 1u << lane;
    const auto pull = [&](std::size_t cross, const Pack& square, const Pack& growth,
                          const Pack& k) {
      springs.rest_length = root(square);
      springs.memory =
          slots_.memory +
          (kinds_of(membrane) * slot.number + cross) * slot_width * request_.memory_numbers +
          slot.first_lane % slot_width;
      springs.constants = constants.law[cross];
      const LawResponse response = springs.template ask<Law, !measuring>(k, growth);
      (has_integrity<Law> ? energies.fractured : energies.dissipated) += response.dissipated;
      if (has_integrity<Law> && !measuring && cross == 0 && response.gone != 0) [[unlikely]]
        report_gone(reach, slot, response.gone);
      if constexpr (measuring) energies.stored += response.energy;
      return where(not_zero(reach.square),
                   response.force_over_length);  // missing springs give NaN
    };
    Pulls pulls;
    pulls.base = pull(0, reach.square, reach.growth, stiffness);
    if constexpr (membrane != Membrane::none)
      pulls.cross = pull(1, reach.square + request_.membrane_distance * request_.membrane_distance,
                         reach.cross_growth, cross_stiffness);
    if (!measuring && slots_.alarm != nullptr) review(reach, slot);
    return pulls;
  }

  std::uint32_t own_place(const Slot& slot, std::uint32_t lane) const {
    return static_cast<std::uint32_t>(request_.rows[slot.row].start) +
           static_cast<std::uint32_t>(slot.site) + lane;
  }
  /// Returns the constants of all springs of a row of one material.
  const SpringConstants& constants_of(const Row& row) const {
    const auto material = static_cast<std::uint32_t>(row.material < 0 ? 0 : row.material);
    return request_
        .springs[std::size_t{material} * (request_.materials + 1) * request_.spring_classes];
  }

  /// Reports the springs of a slot whose integrity became 0. `gone`: bits of lanes.
  void report_gone(const Reach& reach, const Slot& slot, std::uint32_t gone) const {
    Real elongation[width];
    store(elongation,
          reach.growth / (root(present_square(reach.square, reach.growth)) + root(reach.square)));
    for (int lane = 0; lane < width; ++lane) {
      if ((gone >> lane & 1u) == 0) continue;
      const std::int32_t site = slot.site + lane;
      const double found = elongation[lane];
      request_.receive_gone(request_.self, {slot.row, slot.number, {&site, 1}, {&found, 1}});
    }
  }

  /// Asks the failure criterion about the slot's springs above their alarm, and removes broken
  /// ones. Both ends of a spring ask and get the same answer, because their numbers differ only in
  /// sign.
  void review(const Reach& reach, const Slot& slot) const {
    const Stored* alarm = alarms(slot);
    std::uint32_t* neighbour = slots_.neighbour + slot.first_lane;
    Real growth[width], elongation[width];
    const Pack rest_length = root(reach.square);
    store(growth, reach.growth);
    store(elongation,
          reach.growth / (root(present_square(reach.square, reach.growth)) + rest_length));
    for (int lane = 0; lane < width; ++lane) {
      const std::int32_t site = slot.site + lane;
      const std::uint32_t own = own_place(slot, static_cast<std::uint32_t>(lane));
      if (!(growth[lane] > alarm[lane]) || neighbour[lane] == own) continue;
      const double found = elongation[lane];
      const std::uint8_t* broken =
          request_.review(request_.self, {slot.row, slot.number, {&site, 1}, {&found, 1}});
      if (broken != nullptr && *broken != 0) neighbour[lane] = own;
    }
  }

  const KernelRequest& request_;
  const ListedSlots& slots_;
};

template <class Law, KernelConfig config>
class ListedSweep {
  static constexpr int components = config.components();
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  using Springs = ListedForces<Law, config>;

 public:
  static void run(const KernelRequest& request) {
    const Springs springs(request);
    springs.write_records();
    Real* forces[components];
    own_rows(request, forces);
    for (std::uint32_t index = 0; index < static_cast<std::uint32_t>(request.rows_per_plane);
         ++index) {
      const Row& row = request.rows[index];
      Motion<config> motion(request, row);
      Energies<Pack> energies;
      if (row.law != 0) {
        request.other_row(request.self, {index, static_cast<std::int32_t>(index), 0});
        if (motion.accelerated()) motion.add_body_force(forces, row.end);
      } else {
        motion.set_body_force(forces, row.end);
        springs.add(row, index, forces, energies);
      }
      motion.vectors(forces);
      motion.template finish<LawWithMemory<Law>>(index, energies);
    }
  }

  /// Computes the springs of one row for the kernel of another law, which has written the records.
  static void run_row(const KernelRequest& request, const RowPlace& place, RowEnergies& sums) {
    const Row& row = request.rows[place.index];
    Real* forces[components];
    own_rows(request, forces);
    for (Real* force : forces)
      for (int t = 0; t < row.end; t += lanes_of<Real>) store(force + t, Pack(0));
    Energies<Pack> energies;
    Springs(request).add(row, place.index, forces, energies);
    sums = energies.sums();
  }

 private:
  static void own_rows(const KernelRequest& request, Real* (&forces)[components]) {
    for (int c = 0; c < components; ++c)
      forces[c] = static_cast<Real*>(request.scratch) + c * request.scratch_width;
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
