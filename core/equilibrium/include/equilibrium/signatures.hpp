// Signatures tell which sites of a coarse level have the same blocks, because they are made of the
// same springs. A signature is a hash of these springs. Blocks are computed and stored once per
// signature: a box of one material has about a hundred, at any size.
#pragma once

#include <equilibrium/numerics.hpp>

#include <hyperlattice/chance.hpp>

#include <vector>

namespace hyperlattice::equilibrium {

using Signatures = std::vector<std::uint64_t>;  ///< one for each site, [(k * ny + j) * nx + i]

/// Returns the signature extended by some bits.
constexpr std::uint64_t signed_by(std::uint64_t signature, std::uint64_t bits) {
  return mixed_bits(signature ^ bits);
}

/// Returns the signatures of the coarse sites from those of the fine sites, whose springs reach up
/// to `reach` sites. Two different sites with the same signature are almost impossible; they would
/// make the preconditioner worse but not the solution wrong.
Signatures coarse_signatures(Signatures fine, const TrilinearTransfer& transfer, int reach);

}  // namespace hyperlattice::equilibrium
