// Springs of a law with constants, and perhaps a memory, of its own: the law is ordinary code, so
// it is asked lane by lane; lengths and forces stay vectors.
#pragma once

#include <hyperlattice/kernels/response.hpp>
#include <hyperlattice/law.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// What springs give back, and what they have dissipated since the step before.
struct LawResponse {
  Pack force_over_length = 0, energy = 0, dissipated = 0;
};

/// Springs of a vector of particles, base or cross. Always in doubles: a law that is asked lane by
/// lane has nothing to gain from floats.
struct LawSprings {
  Pack rest_length = 0;
  double time_step = 0;             ///< the step before now, s
  const double* constants[lanes];   ///< of each lane's law
  std::uint32_t there = 0;          ///< bit n: lane n has a spring
  double* memory = nullptr;         ///< [number][lane]
  std::uint64_t memory_stride = 0;  ///< between numbers

  /// Keep: the memory becomes that of now; otherwise it stays that of the step before.
  template <LawWithConstants Law, bool Keep>
  LawResponse ask(const Pack& stiffness, const Pack& q) const {
    const Pack length = root(rest_length * rest_length + q);
    double k[lanes], rest[lanes], elongation[lanes], force[lanes] = {}, energy[lanes] = {},
                                                     dissipated[lanes] = {};
    store(k, stiffness);
    store(rest, rest_length);
    store(elongation, q / (length + rest_length));
    for (int lane = 0; lane < lanes; ++lane) {
      if ((there >> lane & 1u) == 0) continue;
      constexpr std::size_t numbers = memory_of<Law>();
      double own[numbers + 1];
      for (std::size_t n = 0; n < numbers; ++n)
        own[n] = memory[n * memory_stride + static_cast<std::size_t>(lane)];
      const auto step = SpringStep<Law>::take({k[lane], rest[lane], elongation[lane], 0, time_step},
                                              constants[lane], own);
      force[lane] = step.force;
      energy[lane] = step.energy;
      dissipated[lane] = step.dissipated;
      if constexpr (Keep)
        for (std::size_t n = 0; n < numbers; ++n)
          memory[n * memory_stride + static_cast<std::size_t>(lane)] = own[n];
    }
    return {load(force) / length, load(energy), load(dissipated)};
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
