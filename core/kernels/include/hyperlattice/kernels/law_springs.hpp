// Springs of a law with a memory. Such a law is ordinary code, so it is called lane by lane;
// lengths and forces stay vectors.
#pragma once

#include <hyperlattice/kernels/response.hpp>
#include <hyperlattice/law.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Response of springs with a memory: force over length, N/m, and energies, J.
struct LawResponse {
  Pack force_over_length = 0, energy = 0;
  Pack dissipated = 0;     ///< in the last step
  std::uint32_t gone = 0;  ///< bit n: the integrity of lane n became 0 in the step
};

/// Springs of a vector of particles, base or cross. Always in doubles: calls lane by lane are no
/// faster in floats.
struct LawSprings {
  Pack rest_length = 0;
  double time_step = 0;               ///< length of the last step, s
  const double* constants = nullptr;  ///< constants of the law, for all lanes
  std::uint32_t there = 0;            ///< bit n: lane n has a spring
  double* memory = nullptr;           ///< memory of the springs, [number][lane]
  std::uint64_t memory_stride = 0;    ///< distance between numbers

  /// Calls the law. Keep: the memory becomes that of the current step; otherwise it stays that of
  /// the previous step.
  template <LawWithMemory Law, bool Keep>
  LawResponse ask(const Pack& stiffness, const Pack& q) const {
    const Pack length = root(present_square(rest_length * rest_length, q));
    double k[lanes], rest[lanes], elongation[lanes], force[lanes] = {}, energy[lanes] = {},
                                                     dissipated[lanes] = {};
    store(k, stiffness);
    store(rest, rest_length);
    store(elongation, q / (length + rest_length));
    LawResponse response;
    const SpringWithMemory<Law> law(constants);
    for (int lane = 0; lane < lanes; ++lane) {
      if ((there >> lane & 1u) == 0) continue;
      constexpr std::size_t numbers = memory_of<Law>();
      double own[numbers];
      for (std::size_t n = 0; n < numbers; ++n)
        own[n] = memory[n * memory_stride + static_cast<std::size_t>(lane)];
      const SpringStep step = law.take({k[lane], rest[lane], elongation[lane], 0, time_step}, own);
      force[lane] = step.force;
      energy[lane] = step.energy;
      dissipated[lane] = step.dissipated;
      if constexpr (has_integrity<Law>) response.gone |= (step.gone ? 1u : 0u) << lane;
      if constexpr (Keep)
        for (std::size_t n = 0; n < numbers; ++n)
          memory[n * memory_stride + static_cast<std::size_t>(lane)] = own[n];
    }
    response.force_over_length = load(force) / length;
    response.energy = load(energy);
    response.dissipated = load(dissipated);
    return response;
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
