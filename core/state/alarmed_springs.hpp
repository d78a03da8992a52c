// The springs that failure criteria must be asked about in the present state.
#pragma once

#include <state/block_set.hpp>

#include <vector>

namespace hyperlattice {

/// A spring above its alarm.
struct AlarmedPlace {
  SpringPlace spring;
  double elongation = 0;  ///< m
};

/// Returns whether criteria must be asked about a spring. `alarm`: elongation, m, from which they
/// must be asked about a spring of one law; `memory`: what the laws keep of the spring.
bool reaches_alarm(const Model& model, const SpringProperties& properties, double alarm,
                   double elongation, const Layout::Memory& memory);
/// Does the same for a spring of a block.
bool reaches_alarm(const BlockSet& blocks, const Block& block, const SpringPlace& spring,
                   double elongation);

/// Returns the springs of each block that are above their alarm with `part` of their elongation.
/// The blocks know their neighbours (BlockSet::exchange).
std::vector<std::vector<AlarmedPlace>> alarmed_springs(const BlockSet& blocks, double part = 1);

}  // namespace hyperlattice
