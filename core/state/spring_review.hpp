// The review of springs by failure criteria.
#pragma once

#include <state/array_criteria.hpp>
#include <state/block_set.hpp>
#include <state/clock.hpp>
#include <state/damage_field.hpp>

#include <span>

namespace hyperlattice {

class SpringReview {
 public:
  SpringReview(const BlockSet& blocks, const Clock& clock, const DamageField& damage,
               const ArrayCriteria& arrays)
      : blocks_(blocks), model_(blocks.model()), clock_(clock), damage_(damage), arrays_(arrays) {}

  /// Asks the failure criteria about springs above their alarm, and notes in the block those that
  /// break. Returns an answer for each spring, valid until the block's next review; 0: the spring
  /// holds. Criteria answer in the order of the scene; a spring that one of them breaks is not
  /// shown to those after it.
  const std::uint8_t* review(Block& block, const AlarmRow& alarm) const;

 private:
  struct Asked;
  void ask(Block& block, const AlarmRow& alarm, const Material::Criterion& criterion,
           const SpringFacts& facts, std::size_t first, std::span<const double> elongation) const;
  void ask(Block& block, const AlarmRow& alarm, const Material::Criterion& criterion,
           const SpringFacts& facts, Asked& asked) const;
  void look_up(Block& block, const AlarmRow& alarm, const Material::Criterion& criterion,
               const Asked& asked) const;

  const BlockSet& blocks_;
  const Model& model_;
  const Clock& clock_;
  const DamageField& damage_;
  const ArrayCriteria& arrays_;
};

}  // namespace hyperlattice
