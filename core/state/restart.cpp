// Saves and restores the state and its energy balance. Blocks are saved as they are, so that a run
// continues with the same number of blocks.
#include <state/archive.hpp>
#include <state/parts.hpp>

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

void visit(Archive& archive, Block& block, int components) {
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
  archive(block.boundary_particles);
  archive(block.contributions);
}

}  // namespace

void Simulation::archive(Archive& archive) {
  Parts& p = *parts_;
  archive.same(p.blocks.size(), "the number of blocks");
  for (Block& block : p.blocks) visit(archive, block, p.model.degrees_of_freedom);
  archive(p.damping);
  archive(p.damping_rate);
  archive(p.last_step);
  archive(p.advanced);
  archive(p.time);
  archive(p.time_rest);
  archive(p.time_held);
  archive(p.steps);
  archive(p.breakages);
  archive(p.failure_energy);
  archive(p.softened_energy);
  archive(p.halted_energy);
  archive(p.gravity_unused);
  archive(p.start_known);
  archive(p.start_energy);
  archive(p.start_potential);
  archive(p.largest_energy);
  if (!archive.restores()) return;
  p.ends.clear();
  for (const Breakage& breakage : p.breakages) p.note_ends(breakage);
}

}  // namespace hyperlattice
