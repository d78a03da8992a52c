// The memory of laws outside an explicit step: its advance to a state of rest or by an implicit
// step, and the integrity of springs that soften.
#pragma once

#include <state/block_set.hpp>
#include <state/energy_account.hpp>
#include <state/equilibrium_update.hpp>
#include <state/weakened_spring.hpp>

#include <string_view>
#include <vector>

namespace hyperlattice {

class LawMemory {
 public:
  LawMemory(BlockSet& blocks, EnergyAccount& energy)
      : blocks_(blocks), model_(blocks.model()), energy_(energy) {}

  /// Advances the memory of all laws to a state of rest, without a duration, or by an implicit step
  /// in time; before the state of the blocks changes. Adds what the laws
  /// dissipate to the energy account, and notes in the blocks the springs whose integrity becomes
  /// 0.
  void advance(const EquilibriumUpdate& to);
  /// Returns the springs of laws that soften whose integrity is below 1, in the order of the
  /// blocks.
  std::vector<WeakenedSpring> weakened() const;
  /// Computes a field that laws give: the mean over each particle's base springs, which count by
  /// their share; not a number where no spring has the field.
  void field(std::string_view name, std::vector<double>& values) const;

 private:
  template <class Visit>
  void for_base_springs(const Block& block, const Visit& visit) const;

  BlockSet& blocks_;
  const Model& model_;
  EnergyAccount& energy_;
};

}  // namespace hyperlattice
