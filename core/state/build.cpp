// Builds a Simulation: arrays, living springs, boundary particles. Each block is first touched by
// the thread that will work on it.
#include <state/parts.hpp>

#include <algorithm>

namespace hyperlattice {

Simulation::Parts::Parts(const Model& m, int wanted)
    : model(m), layout(make_layout(m, wanted)), blocks(layout->blocks.size()), team(wanted) {
  team.for_own(blocks.size(), [&](std::size_t b) { allocate(blocks[b], b); });
  for (Block& block : blocks) add_supports(block);
  acting.resize(model.loads.size());
  for (std::size_t l = 0; l < acting.size(); ++l) {
    acting[l].displacement.resize(model.loads[l].watched.size());
    acting[l].velocity.resize(model.loads[l].watched.size());
    prepares = prepares || model.loads[l].prepares();
    for (const LoadedParticle& loaded : model.loads[l].particles)
      acting[l].moves |= (loaded.displaced | loaded.driven) != 0;
  }
  for (const auto& [particle, velocity] : model.start_velocities) {
    const auto [block, place] = at(particle);
    for (int c = 0; c < 3; ++c) block->velocity[c].set(place, component(velocity, c));
  }
}

void Simulation::Parts::allocate(Block& block, std::size_t number) const {
  block.layout = &layout->blocks[number];
  block.number = number;
  block.rows = block.layout->rows;
  for (int c = 0; c < model.degrees_of_freedom; ++c) {
    block.displacement[c] = Numbers(model.choice.precision, block.layout->sites);
    block.velocity[c] = Numbers(model.choice.precision, block.layout->sites);
  }
  block.scratch = AlignedArray<double>(layout->scratch_numbers());
  block.damped_work.assign(block.rows.size(), 0);
  if (model.softens) block.fracture_work.assign(block.rows.size(), 0);
  const auto is_other = [](const Row& row) { return row.law != 0; };
  if (std::any_of(block.rows.begin(), block.rows.end(), is_other))
    block.other_sums.resize(block.rows.size());
  block.sums.resize(block.rows.size());
  layout->fill(block);
}

void Simulation::Parts::add_supports(Block& block) const {
  std::vector<std::pair<Particle, Contribution>> found;
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    Contribution part;
    part.load = static_cast<std::uint32_t>(l);
    for (const LoadedParticle& loaded : model.loads[l].particles)
      if (layout->place(loaded.particle).block == block.number) {
        part.particle = loaded.particle;
        part.force = loaded.force;
        part.displacement = loaded.displacement;
        part.velocity = loaded.velocity;
        part.displaced = loaded.displaced;
        part.driven = loaded.driven;
        found.emplace_back(loaded.particle, part);
      }
    const std::vector<WatchedParticle>& watched = model.loads[l].watched;
    for (std::uint32_t n = 0; n < watched.size(); ++n) {
      const Place place = layout->place(watched[n].particle);
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
      const Place place = layout->place(particle);
      BoundaryParticle support;
      support.row = static_cast<std::int32_t>(place.row);
      support.site = place.site;
      support.index = place.index;
      support.mass = model.mass(particle);
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

}  // namespace hyperlattice
