// What is kept of the records of damage and of their cells: in checkpoints, and between ranks.
#include <state/damage_records.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Copies the values of each rank to all others, where `all` has those of the ranks one after
/// another. `count`: returns the number of values of a rank.
template <class T, class Count>
void spread_values(Ranks& ranks, std::vector<T>& all, const Count& count) {
  std::size_t first = 0;
  for (int rank = 0; rank < ranks.count(); ++rank) {
    const std::size_t size = count(rank);
    ranks.spread(rank, std::as_writable_bytes(std::span(all).subspan(first, size)));
    first += size;
  }
}

}  // namespace

struct DamageRecords::Kept {
  Particle particle;
  double damage, rate, height, alpha_factor, crack_time;
  std::uint64_t marked, rests_until;
  std::uint32_t present, handed_over;  ///< bits of springs
  double elongation[DamageRecord::most_springs][2], factor[DamageRecord::most_springs][2];
};

DamageRecords::Kept DamageRecords::kept(std::uint32_t number) const {
  const DamageRecord& record = records_[number];
  Kept kept{record.particle,
            damages_[number],
            record.rate,
            record.height,
            record.alpha_factor,
            record.crack_time,
            notes_[number].marked,
            notes_[number].rests_until,
            0,
            0,
            {},
            {}};
  for (std::size_t s = 0; s < record.count; ++s) {
    const DamageSpring& spring = record.all[s];
    kept.present |= (spring.present ? 1U : 0U) << s;
    kept.handed_over |= (spring.handed_over ? 1U : 0U) << s;
    std::copy_n(spring.elongation, 2, kept.elongation[s]);
    std::copy_n(spring.factor, 2, kept.factor[s]);
  }
  return kept;
}

void DamageRecords::restore(const Kept& kept) {
  const std::uint32_t number = index_[kept.particle];
  DamageRecord& record = records_[number];
  set_damage(number, kept.damage);
  record.rate = kept.rate;
  record.height = kept.height;
  record.alpha_factor = kept.alpha_factor;
  record.crack_time = kept.crack_time;
  notes_[number].marked = kept.marked;
  notes_[number].rests_until = kept.rests_until;
  for (std::size_t s = 0; s < record.count; ++s) {
    DamageSpring& spring = record.all[s];
    spring.present = (kept.present >> s & 1U) != 0;
    spring.handed_over = (kept.handed_over >> s & 1U) != 0;
    std::copy_n(kept.elongation[s], 2, spring.elongation);
    std::copy_n(kept.factor[s], 2, spring.factor);
  }
}

void DamageRecords::archive(Archive& archive) {
  std::vector<Kept> all;
  if (!archive.restores()) {
    all.reserve(order_.size());
    for (const std::uint32_t number : order_) all.push_back(kept(number));
  }
  archive(all);
  if (archive.restores()) {
    remove_if([](std::uint32_t) { return true; });
    std::vector<Particle> particles;
    particles.reserve(all.size());
    for (const Kept& one : all) particles.push_back(one.particle);
    add(std::move(particles));
    for (const Kept& one : all) restore(one);
  }
  cells_.archive(archive);
}

void DamageRecords::spread() {
  std::vector<Kept> all(order_.size());
  std::transform(order_.begin(), order_.end(), all.begin(),
                 [this](std::uint32_t number) { return kept(number); });
  spread_values(blocks_.ranks(), all, [this](int rank) { return of_rank(rank).size(); });
  for (const Kept& one : all) restore(one);
  cells_.spread();
}

struct DamageCells::Kept {
  Particle lowest;
  double extension, factor;
  std::uint64_t present, handed_over;
};

/// Returns the cells in use, in the order of their lowest corners.
std::vector<DamageCells::Kept> DamageCells::kept() const {
  std::vector<Kept> all;
  all.reserve(cells_.size());
  for (const DamageCell& cell : cells_)
    if (cell.users > 0)
      all.push_back({cell.corners[0], cell.extension, cell.factor, cell.present ? 1U : 0U,
                     cell.handed_over ? 1U : 0U});
  std::sort(all.begin(), all.end(),
            [](const Kept& a, const Kept& b) { return a.lowest < b.lowest; });
  return all;
}

void DamageCells::restore(const Kept& kept) {
  DamageCell& cell = cells_[at(kept.lowest)];
  cell.extension = kept.extension;
  cell.factor = kept.factor;
  cell.present = kept.present != 0;
  cell.handed_over = kept.handed_over != 0;
}

void DamageCells::archive(Archive& archive) {
  if (empty()) return;
  std::vector<Kept> all;
  if (!archive.restores()) all = kept();
  archive(all);
  if (!archive.restores()) return;
  for (const Kept& one : all) restore(one);
}

void DamageCells::spread() {
  if (empty()) return;
  std::vector<Kept> all = kept();
  spread_values(blocks_.ranks(), all, [&](int rank) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Kept& one) {
      return blocks_.owner(blocks_.at(one.lowest).first->number) == rank;
    }));
  });
  for (const Kept& one : all) restore(one);
}

}  // namespace hyperlattice
