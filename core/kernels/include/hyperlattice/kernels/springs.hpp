// The springs of one row of particles to one neighbour: elongation, law, forces on both ends. This
// is the innermost loop of a step.
//
// Base spring i-j and cross spring i-j' share the vector r between their ends in space. With the
// rest vector R, the difference d of displacements, the heights h and the distance Delta to the
// mirror copy:
//   base:  |r|^2 + (h_j - h_i)^2           = L0^2 + q_b
//          q_b = d.(2 R + d) + (h_j - h_i)^2
//   cross: |r|^2 + (Delta + h_i + h_j)^2   = Lc^2 + q_c
//          q_c = d.(2 R + d) + (h_i + h_j)(2 Delta + h_i + h_j)
// The elongation L - L0 = q / (L + L0) then has no cancellation, however small it is. See
// docs/theory/mirror.md.
#pragma once

#include <hyperlattice/kernels/law_springs.hpp>
#include <hyperlattice/kernels/motion.hpp>
#include <hyperlattice/kernels/response.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Places of a row's particles, and of their neighbours, in the arrays. Element t belongs to site
/// begin + t.
template <KernelConfig config>
struct RowPair {
  using Stored = NumberOf<config.stored>;
  using Real = NumberOf<config.computed>;
  static constexpr int components = config.components();
  const Stored* here[components];
  const Stored* there[components];
  Real* own[components];       ///< forces on the row itself
  Real* received[components];  ///< forces on the neighbours' row
  const std::uint16_t* alive;
  /// Materials of both ends, or mixtures of the row itself; null if the row has one material.
  const std::uint8_t *material_here, *material_there;
  const std::uint32_t* mixture;
  /// Place of each vector's set of weights; null: all weights are 1.
  const std::uint32_t* weight_sets;
  const double* weights;  ///< weights of the neighbour in the first set, the base of these places
  double* memory;  ///< memory of the row's springs to the neighbour, [base, cross][number][site]
};

template <class Law, KernelConfig config>
class Springs {
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  using Pair = RowPair<config.of_rows()>;
  static constexpr Membrane membrane = config.membrane;
  static constexpr int width = lanes_of<Real>;
  static constexpr bool energy = config.measures();

 public:
  /// A row and the index of a neighbour.
  struct Place {
    const Row& row;
    std::uint32_t row_index, neighbour;
  };

  /// Adds the forces of `count` springs (padded to whole vectors) and their energies. Returns
  /// whether any spring is above its alarm. `report`: place of the springs, to report those whose
  /// integrity becomes 0; null: do not report.
  [[gnu::noinline]] static bool add(const KernelRequest& request, const Pair& pair,
                                    const NeighbourGeometry& neighbour, std::uint16_t bit,
                                    const SpringConstants& constants, int count,
                                    Energies<Pack>& energies, const Place* report) {
    const Vec3 rest = neighbour.rest;
    const double twice_delta = 2 * request.membrane_distance;
    Pack base_stiffness = constants.stiffness, cross_stiffness = constants.cross_stiffness;
    Pack alarm = squared_growth<Real>(neighbour.rest_length, constants.alarm);
    const bool several = pair.material_here != nullptr || pair.mixture != nullptr;
    bool rung = false;
    const auto difference_of = [&](std::size_t c, int t) {
      return load_as<Real>(pair.there[c] + t) - load_as<Real>(pair.here[c] + t);
    };
    for (int t = 0; t < count; t += width) {
      const LanesOf<Real> alive = lanes_with<Real>(load_bits<Real>(pair.alive + t), bit);
      const auto counted = [&](Pack whole) {
        if (pair.weight_sets != nullptr)
          whole *= load_weights<Real>(pair.weights, pair.weight_sets + t / lanes, 0);
        return where(alive, whole);
      };
      /// Returns force over length times weight, 0 for missing springs. cross: 0 base springs, 1
      /// cross springs.
      const auto pull_of = [&](int cross, const Pack& stiffness, double rest_length,
                               const Pack& growth) {
        if constexpr (LawWithMemory<Law>) {
          const LawSprings springs =
              law_springs(request, pair, bit, constants, cross, rest_length, t);
          const LawResponse response = springs.template ask<Law, !energy>(stiffness, growth);
          if (has_integrity<Law> && report != nullptr && cross == 0 && response.gone != 0)
              [[unlikely]]
            report_gone(request, pair, *report, t, response.gone);
          (has_integrity<Law> ? energies.fractured : energies.dissipated) +=
              counted(response.dissipated);
          if constexpr (energy) energies.stored += counted(response.energy);
          return counted(response.force_over_length);
        } else {
          const ResponseOf<Pack> response =
              respond<Law, energy>(stiffness, rest_length, growth, constants.law[cross]);
          if constexpr (energy) energies.stored += counted(response.energy);
          return counted(response.force_over_length);
        }
      };
      if (several)
        constants_of_lanes(request, pair, neighbour, t, base_stiffness, cross_stiffness, alarm);
      const Pack dx = difference_of(0, t), dy = difference_of(1, t), dz = difference_of(2, t);
      const Pack q = dx * (2 * rest.x + dx) + dy * (2 * rest.y + dy) + dz * (2 * rest.z + dz);

      Pack difference = 0, total = 0;  // difference and sum of the heights
      Pack base_q = q;
      if constexpr (membrane == Membrane::free) {
        const Pack here = load_as<Real>(pair.here[3] + t), there = load_as<Real>(pair.there[3] + t);
        difference = there - here;
        total = there + here;
        base_q += difference * difference;
      }
      const Pack base_pull = pull_of(0, base_stiffness, neighbour.rest_length, base_q);
      if constexpr (!energy) rung |= any(where(alive, base_q) > alarm);
      Pack pull = base_pull;

      if constexpr (membrane != Membrane::none) {
        const Pack cross_pull = pull_of(1, cross_stiffness, neighbour.cross_rest_length,
                                        q + total * (twice_delta + total));
        pull += cross_pull;
        if constexpr (membrane == Membrane::free) {  // the cross spring pushes both heights in the
                                                     // same direction: not action and reaction
          const Pack along = base_pull * difference,
                     both = cross_pull * (request.membrane_distance + total);
          add_to(pair.own[3] + t, along - both);
          add_to(pair.received[3] + t, -(along + both));
        }
      }
      const Pack fx = pull * (rest.x + dx), fy = pull * (rest.y + dy), fz = pull * (rest.z + dz);
      add_to(pair.own[0] + t, fx);
      add_to(pair.own[1] + t, fy);
      add_to(pair.own[2] + t, fz);
      add_to(pair.received[0] + t, -fx);
      add_to(pair.received[1] + t, -fy);
      add_to(pair.received[2] + t, -fz);
    }
    return rung;
  }

  /// Asks the failure criterion about the row's springs above their alarm, and removes broken ones.
  [[gnu::noinline]] static void review(const KernelRequest& request, const Pair& pair,
                                       const Row& row, std::uint32_t row_index,
                                       std::uint32_t neighbour_index,
                                       const SpringConstants* uniform) {
    constexpr int batch = 64;
    const NeighbourGeometry& neighbour = request.neighbours[neighbour_index];
    const auto bit = static_cast<std::uint16_t>(1u << neighbour_index);
    std::int32_t sites[batch];
    double elongations[batch];
    int found = 0;
    const auto ask = [&] {
      const auto number = static_cast<std::size_t>(found);
      const std::uint8_t* broken = request.review(
          request.self, {row_index, neighbour_index, {sites, number}, {elongations, number}});
      for (int n = 0; broken != nullptr && n < found; ++n)
        if (broken[n] != 0)
          request.alive[row.start + static_cast<std::uint64_t>(sites[n] - row.begin)] &=
              static_cast<std::uint16_t>(~bit);
      found = 0;
    };
    for (int t = 0; t < row.end - row.begin; ++t) {
      if ((pair.alive[t] & bit) == 0) continue;
      const SpringConstants& constants =
          uniform != nullptr ? *uniform : between(request, pair, neighbour, t);
      const double elongation = elongation_of(pair, neighbour, t);
      if (!(elongation > constants.alarm)) continue;
      sites[found] = row.begin + t;
      elongations[found] = elongation;
      if (++found == batch) ask();
    }
    if (found > 0) ask();
  }

 private:
  /// Reports the springs of a vector whose integrity became 0. `gone`: bits of lanes.
  [[gnu::noinline]] static void report_gone(const KernelRequest& request, const Pair& pair,
                                            const Place& place, int t, std::uint32_t gone) {
    const NeighbourGeometry& neighbour = request.neighbours[place.neighbour];
    for (int lane = 0; lane < lanes; ++lane) {
      if ((gone >> lane & 1u) == 0) continue;
      const std::int32_t site = place.row.begin + t + lane;
      const double elongation = elongation_of(pair, neighbour, t + lane);
      request.receive_gone(request.self,
                           {place.row_index, place.neighbour, {&site, 1}, {&elongation, 1}});
    }
  }

  /// Returns the elongation, m, of the base spring of site t.
  static double elongation_of(const Pair& pair, const NeighbourGeometry& neighbour, int t) {
    const auto moved = [&](int c) { return double{pair.there[c][t]} - double{pair.here[c][t]}; };
    const Vec3 d{moved(0), moved(1), moved(2)};
    double q = dot(d, 2 * neighbour.rest + d);
    if constexpr (membrane == Membrane::free) q += moved(3) * moved(3);
    return q / (__builtin_sqrt(neighbour.rest_length * neighbour.rest_length + q) +
                neighbour.rest_length);
  }

  static LawSprings law_springs(const KernelRequest& request, const Pair& pair, std::uint16_t bit,
                                const SpringConstants& constants, int cross, double rest_length,
                                int t) {
    LawSprings springs;
    springs.rest_length = rest_length;
    springs.time_step = 2 * request.back;
    springs.constants = constants.law[cross];
    for (int lane = 0; lane < lanes; ++lane)
      springs.there |= ((pair.alive[t + lane] & bit) != 0 ? 1u : 0u) << lane;
    springs.memory_stride = request.memory_stride;
    springs.memory =
        pair.memory +
        static_cast<std::size_t>(cross) * request.memory_numbers * request.memory_stride + t;
    return springs;
  }

  static void add_to(Real* target, Pack value) { store(target, load(target) + value); }

  static const SpringConstants& between(const KernelRequest& request, const Pair& pair,
                                        const NeighbourGeometry& neighbour, int t) {
    if (pair.mixture != nullptr) {
      const auto n = static_cast<std::size_t>(&neighbour - request.neighbours.data());
      return request
          .springs[request.mixture_springs[pair.mixture[t] * request.neighbours.size() + n]];
    }
    const std::uint32_t a = pair.material_here[t], b = pair.material_there[t];
    return request.springs[(a * request.materials + b) * request.spring_classes +
                           neighbour.site.spring_class];
  }

  static void constants_of_lanes(const KernelRequest& request, const Pair& pair,
                                 const NeighbourGeometry& neighbour, int t, Pack& base_stiffness,
                                 Pack& cross_stiffness, Pack& alarm) {
    Real base[width], cross[width], alarms[width];
    for (int lane = 0; lane < width; ++lane) {
      const SpringConstants& constants = between(request, pair, neighbour, t + lane);
      base[lane] = static_cast<Real>(constants.stiffness);
      cross[lane] = static_cast<Real>(constants.cross_stiffness);
      alarms[lane] =
          static_cast<Real>(squared_growth<Real>(neighbour.rest_length, constants.alarm));
    }
    base_stiffness = load(base);
    cross_stiffness = load(cross);
    alarm = load(alarms);
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
