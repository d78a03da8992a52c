// The springs of one row for a static solver: force over length of each spring, and its tangent.
//
// For a spring with the vector r between its ends, length L, force f(L - L0) and derivative f', the
// tangent with respect to the difference of its ends is
//   K = axial r r^T / l^2 + pull I,   pull = f / L,   axial = (f' - f / L) l^2 / L^2,
// with the lattice constant l, so that both are in N/m. The force is pull r. The same holds for
// cross springs, with the fourth component Delta + h_i + h_j. See docs/theory/statics.md. In a step
// in time elongation and length are means over the step, and r is the vector between mean places:
// docs/theory/implicit.md.
#pragma once

#include <hyperlattice/kernels/springs.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Returns the derivative of the law's force, N/m: the law's own tangent(); the stiffness of a
/// linear law; else a central difference.
template <class Law>
inline Pack tangent_of(const SpringOf<Pack>& spring, const double* constants) {
  const auto force = [&](Pack elongation) {
    return force_of<Law>(SpringOf<Pack>{spring.stiffness, spring.rest_length, elongation},
                         constants);
  };
  if constexpr (requires { Law::tangent(spring.stiffness, spring.elongation); }) {
    return Law::tangent(spring.stiffness, spring.elongation);
  } else if constexpr (requires {
                         Law::tangent(spring, struct_of<typename Law::Constants>(constants));
                       }) {
    return Law::tangent(spring, struct_of<typename Law::Constants>(constants));
  } else if constexpr (is_linear<Law>) {
    return force(Pack(1));
  } else {
    const Pack h = 1e-6 * spring.rest_length;
    return (force(spring.elongation + h) - force(spring.elongation - h)) / (2 * h);
  }
}

/// Force, N, tangent, N/m, and energy, J, of springs.
struct Linearised {
  Pack force = 0, tangent = 0, energy = 0;
};

template <class Law, Membrane membrane>
struct Tangent {
  /// Writes pull and axial of the springs. Returns their stored energy, J.
  static double run(const SpringRow& row) {
    Pack stored{};
    for (int t = 0; t < row.count; t += lanes)
      for (std::size_t cross = 0; cross < (membrane == Membrane::none ? 1 : 2); ++cross)
        stored += one(row, cross, t);
    return sum(stored);
  }

 private:
  struct Stretch {
    Pack elongation, length, square;  ///< m, m, m2: of the length
  };

  /// Returns the stretch of springs whose squared lengths grew by `q`.
  static Stretch grown(double rest_length, Pack q) {
    const Pack square = present_square(Pack(rest_length * rest_length), q), length = root(square);
    return {q / (length + rest_length), length, square};
  }

  /// Returns the stretch of a vector of springs, base (cross 0) or cross (1): in a step in time the
  /// mean of that at the start and that at the end.
  static Stretch stretch(const SpringRow& row, std::size_t cross, int t) {
    const double rest[3] = {row.rest.x, row.rest.y, row.rest.z},
                 rest_length = cross == 0 ? row.rest_length : row.cross_rest_length;
    const bool moves = row.here_before[0] != nullptr;
    Pack now{}, before{};  // growth of squared lengths
    const auto add = [&](Pack apart, Pack apart_before, double twice) {
      if (moves) {
        apart = apart_before + (apart - apart_before) * (1 / row.forward);
        before += apart_before * (twice + apart_before);
      }
      now += apart * (twice + apart);
    };
    for (int c = 0; c < 3; ++c)
      add(load(row.there[c] + t) - load(row.here[c] + t),
          moves ? load(row.there_before[c] + t) - load(row.here_before[c] + t) : Pack{},
          2 * rest[c]);
    if constexpr (membrane == Membrane::free) {
      const auto rise = [&](const double* there, const double* here) {
        return cross == 0 ? load(there + t) - load(here + t) : load(there + t) + load(here + t);
      };
      add(rise(row.there[3], row.here[3]),
          moves ? rise(row.there_before[3], row.here_before[3]) : Pack{},
          cross == 0 ? 0 : 2 * row.membrane_distance);
    }
    const Stretch at = grown(rest_length, now);
    if (!moves) return at;
    const Pack elongation = (1 - row.forward) * grown(rest_length, before).elongation +
                            row.forward * at.elongation,
               length = rest_length + elongation;
    return {elongation, length, length * length};
  }

  /// Writes the results of a vector of springs, base (cross 0) or cross (1). Returns their energy.
  static Pack one(const SpringRow& row, std::size_t cross, int t) {
    const Pack weight = load(row.weight + t);
    const Stretch at_ends = stretch(row, cross, t);
    const SpringOf<Pack> spring{load((cross == 0 ? row.stiffness : row.cross_stiffness) + t),
                                Pack(cross == 0 ? row.rest_length : row.cross_rest_length),
                                at_ends.elongation};
    const Linearised at = linearised(row, cross, t, spring, weight);
    const Pack force_over_length = at.force / at_ends.length;
    const Pack along =
        (at.tangent - force_over_length) * (row.spacing * row.spacing) / at_ends.square;
    const LanesOf<double> there_is =
        not_zero(weight);  // missing springs have values that may not be finite
    store((cross == 0 ? row.pull : row.cross_pull) + t,
          where(there_is, weight * force_over_length));
    store((cross == 0 ? row.axial : row.cross_axial) + t, where(there_is, weight * along));
    return where(there_is, weight * at.energy);
  }

  static Linearised linearised(const SpringRow& row, std::size_t cross, int t,
                               const SpringOf<Pack>& spring, Pack weight) {
    if constexpr (LawWithMemory<Law>)
      return lane_by_lane(row, cross, t, spring, weight);
    else
      return {force_of<Law>(spring, row.law[cross]), tangent_of<Law>(spring, row.law[cross]),
              energy_of<Law>(spring, row.law[cross])};
  }

  /// Calls a law with a memory, which stays that of the start of the step.
  static Linearised lane_by_lane(const SpringRow& row, std::size_t cross, int t,
                                 const SpringOf<Pack>& spring, Pack weight) {
    double k[lanes], rest[lanes], elongation[lanes], there[lanes],
        force[lanes] = {}, tangent[lanes] = {}, energy[lanes] = {};
    store(k, spring.stiffness);
    store(rest, spring.rest_length);
    store(elongation, spring.elongation);
    store(there, weight);
    const SpringWithMemory<Law> law(row.law[cross]);
    for (int lane = 0; lane < lanes; ++lane) {
      if (there[lane] == 0) continue;
      constexpr std::size_t numbers = memory_of<Law>();
      double own[numbers];
      for (std::size_t n = 0; n < numbers; ++n)
        own[n] = row.memory[cross][n * row.memory_stride + static_cast<std::size_t>(t + lane)];
      const SpringState state{k[lane], rest[lane], elongation[lane], 0, row.time_step};
      tangent[lane] = law.tangent(state, own);
      const SpringStep step = law.take(state, own);
      force[lane] = step.force;
      energy[lane] = step.energy;
    }
    return {load(force), load(tangent), load(energy)};
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
