// The blocks of a state: arrays, living springs, boundary particles. Each block is first touched by
// the thread that will work on it.
#include <process/small_pages.hpp>
#include <state/block_set.hpp>

#include <algorithm>

namespace hyperlattice {

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
  set_start_velocities();
  if (ranks.count() > 1) find_first_of_ranks();
  if (is_whole()) return;
  ranks_.meet(Ranks::Meeting::state);
  halo_->exchange(blocks_, ranks_);
}

void BlockSet::set_start_velocities() const {
  const std::vector<StartVelocity>& all = model_.loads.start_velocities;
  auto next = all.begin();
  for_runs([&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
    const Particle end = first + count;
    while (next != all.end() && next->first + next->count <= first) ++next;
    if (!is_mine(block) && !keeps_whole_) return;
    for (auto of = next; of != all.end() && of->first < end; ++of)
      for (Particle p = std::max(first, of->first); p < std::min(end, of->first + of->count); ++p)
        for (int c = 0; c < 3; ++c) block.velocity[c].set(place + (p - first), of->velocity[c]);
  });
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
  allocate_motion(block, at_once);
  if (at_once) fill(block);
}

/// Allocates displacements and velocities; if they are not needed at once, also the room of living
/// springs that the halo writes into.
void BlockSet::allocate_motion(Block& block, bool at_once) const {
  const auto components = static_cast<std::size_t>(model_.degrees_of_freedom);
  for (Numbers* const motion : {block.displacement, block.velocity})
    block.component_stride =
        Numbers::allocate_together(model_.springs.choice.precision, block.layout->sites,
                                   std::span(motion, components), at_once);
  if (at_once) return;
  block.alive = AlignedArray<std::uint16_t>(block.layout->sites, FilledLater());
  // The halo fills a few planes.
  for (Numbers* const motion : {block.displacement, block.velocity}) {
    std::byte* const first = motion[0].bytes().data();
    const std::span<std::byte> last = motion[components - 1].bytes();
    use_small_pages({first, last.data() + last.size()});
  }
  use_small_pages(std::as_writable_bytes(std::span(block.alive.get(), block.alive.size())));
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

  std::size_t particles = 0;
  for (std::size_t n = 0; n < found.size(); ++n)
    particles += n == 0 || found[n].first != found[n - 1].first ? 1 : 0;
  block.boundary_particles.reserve(particles);
  block.contributions.reserve(found.size());
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

}  // namespace hyperlattice
