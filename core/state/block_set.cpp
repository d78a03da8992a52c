// The blocks of a state: arrays, living springs, boundary particles. Each block is first touched by
// the thread that will work on it.
#include <state/block_set.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

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

BlockSet::BlockSet(const Model& model, int threads, Ranks& ranks, int blocks)
    : model_(model),
      layout_(make_layout(model, blocks)),
      blocks_(layout_->blocks.size()),
      team_(threads),
      ranks_(ranks),
      owners_(owners_of(blocks_.size(), ranks.count())) {
  const auto [first, last] = std::equal_range(owners_.begin(), owners_.end(), ranks.rank());
  first_mine_ = static_cast<std::size_t>(first - owners_.begin());
  last_mine_ = static_cast<std::size_t>(last - owners_.begin());
  keeps_whole_ = !needs_whole(model).empty();
  whole_ = ranks.count() == 1 || keeps_whole_ ? Whole::everywhere : Whole::nowhere;
  if (ranks.count() > 1) halo_.emplace(model, *layout_, owners_, ranks.rank());
  team_.for_own(blocks_.size(), [&](std::size_t b) { allocate(blocks_[b], b); });
  for (Block& block : blocks_) add_supports(block);
  for (const auto& [particle, velocity] : model.loads.start_velocities) {
    const auto [block, place] = at(particle);
    for (int c = 0; c < 3; ++c) block->velocity[c].set(place, velocity[c]);
  }
  if (ranks.count() > 1) find_first_of_ranks();
  if (is_whole()) return;
  ranks_.meet(Ranks::Meeting::state);
  halo_->exchange(blocks_, ranks_);
}

/// Blocks, and so ranks, follow each other as their particles do.
void BlockSet::find_first_of_ranks() {
  first_of_rank_.assign(static_cast<std::size_t>(ranks_.count()) + 1, model_.body.particles);
  for_runs([&](const Block& block, std::uint64_t, Particle first, std::uint64_t) {
    Particle& known = first_of_rank_[static_cast<std::size_t>(owners_[block.number])];
    known = std::min(known, first);
  });
  for (std::size_t rank = first_of_rank_.size() - 1; rank > 0; --rank)  // some may have no block
    first_of_rank_[rank - 1] = std::min(first_of_rank_[rank - 1], first_of_rank_[rank]);
}

/// Allocates a block. Of another rank's block little is touched before it is gathered, so that it
/// takes little memory.
void BlockSet::allocate(Block& block, std::size_t number) {
  const Precision precision = model_.springs.choice.precision;
  block.layout = &layout_->blocks[number];
  block.number = number;
  block.rows = block.layout->rows;
  block.damped_work.assign(block.rows.size(), 0);
  if (model_.springs.softens || !model_.cohesive.empty())
    block.fracture_work.assign(block.rows.size(), 0);
  const auto is_other = [](const Row& row) { return row.law != 0; };
  if (!model_.cohesive.empty() || std::any_of(block.rows.begin(), block.rows.end(), is_other))
    block.other_sums.resize(block.rows.size());
  block.sums.resize(block.rows.size());
  const bool at_once = is_mine(block) || keeps_whole_;
  const auto components = static_cast<std::size_t>(model_.degrees_of_freedom);
  for (Numbers* const motion : {block.displacement, block.velocity})
    block.component_stride = Numbers::allocate_together(precision, block.layout->sites,
                                                        std::span(motion, components), at_once);
  if (at_once)
    fill(block);
  else
    block.alive = AlignedArray<std::uint16_t>(block.layout->sites, FilledLater());
}

/// Allocates and fills what a block has besides its motion.
void BlockSet::fill(Block& block) const {
  if (block.scratch.size() > 0) return;
  block.scratch = AlignedArray<double>(layout_->scratch_numbers());
  layout_->fill(block);
}

void BlockSet::add_supports(Block& block) const {
  std::vector<std::pair<Particle, Contribution>> found;
  for (std::size_t l = 0; l < model_.loads.size(); ++l) {
    Contribution part;
    part.load = static_cast<std::uint32_t>(l);
    for (const LoadedParticle& loaded : model_.loads[l].particles)
      if (layout_->place(loaded.particle).block == block.number) {
        part.particle = loaded.particle;
        part.force = loaded.force;
        part.displacement = loaded.displacement;
        part.velocity = loaded.velocity;
        part.displaced = loaded.displaced;
        part.driven = loaded.driven;
        found.emplace_back(loaded.particle, part);
      }
    const std::vector<WatchedParticle>& watched = model_.loads[l].watched;
    for (std::uint32_t n = 0; n < watched.size(); ++n) {
      const Place place = layout_->place(watched[n].particle);
      if (place.block != block.number) continue;
      block.watched.push_back({part.load, n, place.index});
      if (!watched[n].answered) continue;
      Contribution answer;
      answer.load = part.load;
      answer.particle = watched[n].particle;
      answer.watched = n;
      found.emplace_back(answer.particle, answer);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });

  Particle last = Body::no_particle;
  for (auto& [particle, part] : found) {
    if (particle != last) {
      const Place place = layout_->place(particle);
      BoundaryParticle support;
      support.row = static_cast<std::int32_t>(place.row);
      support.site = place.site;
      support.index = place.index;
      support.mass = model_.mass(particle);
      block.boundary_particles.push_back(support);
      last = particle;
    }
    part.support = static_cast<std::uint32_t>(block.boundary_particles.size() - 1);
    block.boundary_particles.back().axes |= part.displaced | part.driven;
    block.contributions.push_back(part);
  }
  block.held_force.resize(block.boundary_particles.size());
  std::uint32_t next = 0;
  for (std::size_t r = 0; r < block.rows.size(); ++r) {
    block.rows[r].first_boundary_particle = next;
    while (next < block.boundary_particles.size() &&
           block.boundary_particles[next].row == static_cast<std::int32_t>(r))
      ++next;
    block.rows[r].last_boundary_particle = next;
  }
}

LawNumbers BlockSet::law_numbers(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                                 std::int32_t site, bool cross) const {
  if (model_.springs.memory == 0) return {};
  return read_numbers(layout_->memory(block, row, neighbour, site, cross), model_.springs.memory);
}

std::pair<Vec3, double> BlockSet::motion(Particle particle) const {
  const auto [home, index] = at(particle);
  const auto number = [&, &of = *home, n = index](std::size_t c) { return of.displacement[c][n]; };
  return {{number(0), number(1), number(2)}, model_.degrees_of_freedom == 4 ? number(3) : 0.0};
}

double BlockSet::elongation(const SpringEnds& spring, const SpringProperties& properties) const {
  const auto [at_a, height_a] = motion(spring.a);
  const auto [at_b, height_b] = motion(spring.b);
  return properties.elongation(0, properties.growth(0, at_b - at_a, height_b - height_a,
                                                    model_.body.grid.membrane_distance));
}

void BlockSet::note_gone(Block& block, const AlarmRow& springs) const {
  for (std::size_t n = 0; n < springs.sites.size(); ++n)
    block.broken.push_back(
        {layout_->spring(block, springs.row, springs.neighbour, springs.sites[n]),
         springs.elongation[n], springs.row, springs.neighbour, springs.sites[n], true});
}

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
  if (archive.restores()) whole_ = Whole::everywhere;
  archive.same(blocks_.size(), "the number of blocks");
  for (Block& block : blocks_) visit_all(archive, block);
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

}  // namespace hyperlattice
