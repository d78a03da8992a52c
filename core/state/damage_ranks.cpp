// What the ranks tell each other of damage. Each computes the records of its own particles
// (damage_records.hpp).
#include <state/damage_field.hpp>

#include <algorithm>

namespace hyperlattice {

/// Tells the other ranks the damage of own records after the step, and what else of them decides.
void DamageField::share_growth() {
  Ranks& ranks = blocks_.ranks();
  if (ranks.is_alone() || records_.order().empty()) return;
  struct Growth {
    double damage, rate, lag;
    std::uint64_t rests_until;
  };
  ranks.meet(Ranks::Meeting::damage);
  for (int rank = 0; rank < ranks.count(); ++rank) {
    const std::span<const std::uint32_t> of_rank = records_.of_rank(rank);
    std::vector<Growth> all(of_rank.size());
    if (rank == ranks.rank())
      std::transform(of_rank.begin(), of_rank.end(), all.begin(), [this](std::uint32_t number) {
        const DamageRecord& record = records_[number];
        return Growth{next_[number], record.rate, record.lag, records_.note(number).rests_until};
      });
    ranks.spread(rank, std::as_writable_bytes(std::span(all)));
    for (std::size_t n = 0; n < all.size(); ++n) {
      DamageRecord& record = records_[of_rank[n]];
      next_[of_rank[n]] = all[n].damage;
      record.rate = all[n].rate;
      record.lag = all[n].lag;
      records_.note(of_rank[n]).rests_until = all[n].rests_until;
    }
  }
}

void DamageField::gather() {
  if (empty() || is_whole_ || blocks_.ranks().is_alone()) return;
  blocks_.ranks().meet(Ranks::Meeting::damage);
  records_.spread();
  is_whole_ = true;
}

}  // namespace hyperlattice
