// Which sites of a coarse level have the same blocks: those that are made of the same springs. Each
// has a number that stands for all of them, and blocks are made and kept once a number: of a box of
// one material there are about a hundred, whatever its size.
#pragma once

#include "numerics.hpp"

#include <hyperlattice/chance.hpp>

#include <vector>

namespace hyperlattice::statics {

using Signatures = std::vector<std::uint64_t>;  ///< of the sites of a box, [(k * ny + j) * nx + i]

constexpr std::uint64_t signed_by(std::uint64_t signature, std::uint64_t bits) {
  return mixed_bits(signature ^ bits);
}

/// Of the coarse sites, from those of the fine ones, which are joined to others up to `reach` sites
/// away. That two sites which differ have one number is next to impossible, and would spoil a
/// preconditioner, no solution.
Signatures coarse_signatures(Signatures fine, const TrilinearTransfer& transfer, int reach);

}  // namespace hyperlattice::statics
