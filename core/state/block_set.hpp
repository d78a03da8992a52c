// The blocks in which the state of a body is stored, the layout that says what is where, and the
// threads that work on them.
#pragma once

#include <model/model.hpp>
#include <process/team.hpp>
#include <state/archive.hpp>
#include <state/block.hpp>
#include <state/layout.hpp>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace hyperlattice {

/// The numbers that the laws of a spring keep.
using LawNumbers = std::array<double, max_spring_memory>;

/// Reads the first `count` of these numbers.
inline LawNumbers read_numbers(const Layout::Memory& memory, std::uint32_t count) {
  LawNumbers numbers{};
  for (std::uint32_t n = 0; n < count; ++n) numbers[n] = memory.first[n * memory.stride];
  return numbers;
}

class BlockSet {
 public:
  BlockSet(const Model& model, int threads);

  const Model& model() const { return model_; }
  const Layout& layout() const { return *layout_; }
  Team& team() const { return team_; }

  std::size_t size() const { return blocks_.size(); }
  Block& operator[](std::size_t number) { return blocks_[number]; }
  const Block& operator[](std::size_t number) const { return blocks_[number]; }
  auto begin() { return blocks_.begin(); }
  auto end() { return blocks_.end(); }
  auto begin() const { return blocks_.begin(); }
  auto end() const { return blocks_.end(); }

  /// Returns the block that stores a particle, and the particle's index in its arrays.
  std::pair<const Block*, std::uint64_t> at(Particle particle) const {
    const Place place = layout_->place(particle);
    return {&blocks_[place.block], place.index};
  }
  /// Calls visit(block, index, first particle, count) for all particles in their order.
  template <class Visit>
  void for_runs(const Visit& visit) const {
    layout_->for_stretches([&](const Stretch& stretch) {
      visit(blocks_[stretch.block], stretch.index, stretch.first, stretch.count);
    });
  }

  /// Copies into the block what it reads of other blocks and of its own state.
  void exchange(Block& block) const { layout_->exchange(blocks_, block); }
  /// Returns what the laws keep of a spring, or of its cross spring. The spring is named by its
  /// place, as in AlarmRow.
  LawNumbers law_numbers(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                         std::int32_t site, bool cross) const;
  /// Returns the displacement of a particle and its height, m.
  std::pair<Vec3, double> motion(Particle particle) const;
  /// Returns the present elongation of a base spring, m.
  double elongation(const SpringEnds& spring, const SpringProperties& properties) const;
  /// Notes in the block that the integrity of these springs became 0.
  void note_gone(Block& block, const AlarmRow& springs) const;

  /// Saves or restores the blocks as they are, so that a run continues with the same number of
  /// blocks.
  void archive(Archive& archive);

 private:
  void allocate(Block& block, std::size_t number) const;
  void add_supports(Block& block) const;

  const Model& model_;
  std::unique_ptr<Layout> layout_;
  std::vector<Block> blocks_;
  mutable Team team_;  // reading the state in parallel does not change it
};

}  // namespace hyperlattice
