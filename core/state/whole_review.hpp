// The review of all springs at once by failure criteria, in states that no explicit step reviews:
// states of rest and the ends of implicit steps.
#pragma once

#include <state/block_set.hpp>
#include <state/spring_review.hpp>

#include <vector>

namespace hyperlattice {

class WholeReview {
 public:
  WholeReview(BlockSet& blocks, const SpringReview& review, ArrayCriteria& arrays)
      : blocks_(blocks), review_(review), arrays_(arrays) {}

  /// Removes the springs that criteria break in the present state, and notes them in the blocks.
  void remove_broken();
  /// Returns how far the present state is beyond the first failure: the largest fraction by which
  /// all elongations could be smaller and some spring would still break, 0 to 1; negative if none
  /// breaks. Changes nothing, not the memory of criteria either.
  double overshoot();

 private:
  using AlarmedOfBlocks = std::vector<std::vector<AlarmedPlace>>;

  AlarmedOfBlocks alarmed();
  bool breaks(Block& block, const AlarmedPlace& alarmed, double part) const;
  bool any_breaks(const AlarmedOfBlocks& alarmed, double part);

  BlockSet& blocks_;
  const SpringReview& review_;
  ArrayCriteria& arrays_;
};

}  // namespace hyperlattice
