// What the ranks tell each other of their blocks, and blocks in checkpoints.
#include <state/block_set.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::size_t most_at_once = 1 << 20;  // bytes of a message that passes a block on

template <class T>
void visit(Archive& archive, const AlignedArray<T>& array) {
  archive(std::span(array.get(), array.size()));
}

/// Saves the memory in the order of its keys, so that equal memories have equal bytes.
void visit(Archive& archive, FailureMemory& memory) {
  struct Kept {
    FailureKey key;
    FailureMemory::mapped_type numbers;
  };
  std::vector<Kept> all;
  if (!archive.restores())
    for (const auto& [key, numbers] : memory) all.push_back({key, numbers});
  archive(all);
  if (!archive.restores()) return;
  memory.clear();
  for (const Kept& kept : all) memory.emplace_hint(memory.end(), kept.key, kept.numbers);
}

/// What a step finds and the next evaluation does not.
void visit_found(Archive& archive, Block& block) {
  archive(block.broken);
  archive(block.noted);
}

void visit_results(Archive& archive, Block& block) {
  archive(block.damped_work);
  archive(block.fracture_work);
  archive(block.other_sums);
  archive(block.sums);
  archive(block.boundary_particles);
  archive(block.held_force);
  archive(block.contributions);
}

void visit_body(Archive& archive, Block& block, int components) {
  for (int c = 0; c < components; ++c) {
    archive(block.displacement[c].bytes());
    archive(block.velocity[c].bytes());
  }
  visit(archive, block.alive);
  visit(archive, block.memory);
  visit(archive, block.failure_memory);
  visit(archive, block.listed.neighbour);
  archive(block.damped_work);
  archive(block.fracture_work);
}

void visit(Archive& archive, Block& block, int components) {
  visit_body(archive, block, components);
  archive(block.boundary_particles);
  archive(block.contributions);
}

}  // namespace

template <class Parts>
void BlockSet::spread(const Parts& parts, bool to_all) {
  for (Block& block : blocks_) {
    const int owner = owners_[block.number], here = ranks_.rank();
    if (!to_all && owner == 0) continue;
    if (!to_all && here != 0 && here != owner) continue;
    Archive archive(
        [&](void* data, std::size_t size) {
          const std::span bytes(static_cast<std::byte*>(data), size);
          if (to_all) return ranks_.spread(owner, bytes);
          const OutgoingBytes out{0, bytes};
          const IncomingBytes in{owner, bytes};
          if (here == owner)
            ranks_.exchange({&out, 1}, {});
          else
            ranks_.exchange({}, {&in, 1});
        },
        owner != here);
    parts(archive, block);
  }
}

void BlockSet::gather(Whole where) {
  if (ranks_.is_alone() || whole_ >= where) return;
  ranks_.meet(Ranks::Meeting::state);
  spread([&](Archive& archive, Block& block) { visit_all(archive, block); },
         where == Whole::everywhere);
  whole_ = where;
}

void BlockSet::gather() { gather(Whole::everywhere); }
void BlockSet::gather_in_first() { gather(Whole::in_first); }

void BlockSet::collect(Particle first, std::uint64_t count, std::size_t components,
                       std::span<double> values) {
  if (ranks_.is_alone() || whole_ != Whole::nowhere) return;
  ranks_.meet(Ranks::Meeting::state);
  for (int rank = 1; rank < ranks_.count(); ++rank) {
    const auto r = static_cast<std::size_t>(rank);
    const Particle from = std::max(first, first_of_rank_[r]),
                   to = std::min(first + count, first_of_rank_[r + 1]);
    if (from >= to) continue;
    const auto bytes = std::as_writable_bytes(
        values.subspan((from - first) * components, (to - from) * components));
    const OutgoingBytes out{0, bytes};
    const IncomingBytes in{rank, bytes};
    if (ranks_.rank() == rank) ranks_.exchange({&out, 1}, {});
    if (ranks_.is_first()) ranks_.exchange({}, {&in, 1});
  }
}

void BlockSet::gather_results() {
  if (ranks_.is_alone()) return;
  ranks_.meet(Ranks::Meeting::results);
  spread(visit_results);
}

void BlockSet::gather_broken() { spread(visit_found); }

std::int64_t BlockSet::exchange_ranks() {
  std::int64_t found = 0;
  if (ranks_.is_alone()) return found;
  for (std::size_t b = first_mine_; b < last_mine_; ++b)
    found += static_cast<std::int64_t>(blocks_[b].broken.size() + blocks_[b].noted.size());
  found = ranks_.meet(Ranks::Meeting::step, found);
  whole_ = Whole::nowhere;
  if (!keeps_whole_) {
    halo_->exchange(blocks_, ranks_);
    if (found > 0 && !model_.cohesive.empty())
      spread([](Archive& archive, Block& block) { archive(block.noted); });
    return found;
  }
  spread([&](Archive& archive, Block& block) {
    visit_all(archive, block);
    visit_found(archive, block);
  });
  whole_ = Whole::everywhere;
  return found;
}

void BlockSet::visit_all(Archive& archive, Block& block) const {
  if (archive.restores()) fill(block);
  visit(archive, block, model_.degrees_of_freedom);
}

void BlockSet::archive(Archive& archive) {
  archive.same(blocks_.size(), "the number of blocks");
  if (archive.restores()) return restore(archive);
  for (Block& block : blocks_)
    if (is_passed(block))
      take(archive, block);
    else
      visit_all(archive, block);
}

/// Restores all blocks, one after another, of which this rank keeps its own and the halo.
void BlockSet::restore(Archive& archive) {
  for (Block& block : blocks_) {
    visit_all(archive, block);
    if (is_mine(block) || keeps_whole_) continue;
    allocate_motion(block, false);
    block.material = {};
    block.mixture = {};
    block.cell_moduli = {};
    block.memory = {};
    block.listed = {};
    block.scratch = {};
    block.failure_memory.clear();
  }
  whole_ = ranks_.is_alone() || keeps_whole_ ? Whole::everywhere : Whole::nowhere;
  if (is_whole()) return;
  ranks_.meet(Ranks::Meeting::state);
  halo_->exchange(blocks_, ranks_);
}

void BlockSet::archive_body(Archive& archive) {
  if (archive.restores()) whole_ = Whole::everywhere;
  archive.same(blocks_.size(), "the number of blocks");
  for (Block& block : blocks_) {
    if (archive.restores()) fill(block);
    archive.same(block.layout->sites, "the size of its blocks");
    archive.same(block.rows.size(), "the rows of its blocks");
    archive.same(block.memory.size(), "the memory of its laws");
    archive.same(block.fracture_work.size(), "the laws that soften");
    visit_body(archive, block, model_.degrees_of_freedom);
  }
}

/// Passes a block to the first rank. Each piece follows a meeting that tells its size; the size 0
/// ends the block.
void BlockSet::pass(Block& block) {
  std::vector<std::byte> piece;
  piece.reserve(most_at_once);
  const auto send = [&] {
    ranks_.meet(Ranks::Meeting::state, static_cast<std::int64_t>(piece.size()));
    const OutgoingBytes out{0, piece};
    if (!piece.empty()) ranks_.exchange({&out, 1}, {});
  };
  Archive archive(
      [&](void* data, std::size_t size) {
        for (const std::byte* from = static_cast<const std::byte*>(data); size > 0;) {
          const std::size_t count = std::min(size, most_at_once - piece.size());
          piece.insert(piece.end(), from, from + count);
          from += count;
          size -= count;
          if (piece.size() < most_at_once) continue;
          send();
          piece.clear();
        }
      },
      false);
  visit_all(archive, block);
  if (!piece.empty()) send();
  piece.clear();
  send();
}

/// Takes the pieces of another rank's block into the archive of the first rank. In any other rank
/// only waits until they have passed.
void BlockSet::take(Archive& archive, const Block& block) {
  std::vector<std::byte> piece;
  for (;;) {
    piece.resize(static_cast<std::size_t>(ranks_.meet(Ranks::Meeting::state)));
    if (piece.empty()) return;
    if (!ranks_.is_first()) continue;
    const IncomingBytes in{owners_[block.number], piece};
    ranks_.exchange({}, {&in, 1});
    archive(std::span(piece));
  }
}

void BlockSet::pass_to_first() {
  Archive nothing([](void*, std::size_t) {}, false);
  for (Block& block : blocks_) {
    if (!is_passed(block)) continue;
    if (is_mine(block))
      pass(block);
    else
      take(nothing, block);
  }
}

}  // namespace hyperlattice
