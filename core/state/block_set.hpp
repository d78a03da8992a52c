// The blocks in which the state of a body is stored, the layout that says what is where, and the
// threads that work on them.
#pragma once

#include <model/model.hpp>
#include <process/team.hpp>
#include <ranks/ranks.hpp>
#include <state/archive.hpp>
#include <state/block.hpp>
#include <state/halo.hpp>
#include <state/layout.hpp>

#include <array>
#include <memory>
#include <optional>
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
  /// Stores the body in a block for each thread.
  BlockSet(const Model& model, int threads) : BlockSet(model, threads, Ranks::alone(), threads) {}
  /// Stores the body in so many blocks at most, which the ranks share. Each rank has all blocks,
  /// but only its own are up to date between steps; see gather().
  BlockSet(const Model& model, int threads, Ranks& ranks, int blocks);

  const Model& model() const { return model_; }
  const Layout& layout() const { return *layout_; }
  Team& team() const { return team_; }
  Ranks& ranks() const { return ranks_; }

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

  /// Calls work(block), on the threads of this rank, for each block that the rank computes; for all
  /// blocks while it acts alone.
  template <class Work>
  void for_mine(const Work& work) {
    const bool all = ranks_.is_alone();
    const std::size_t first = all ? 0 : first_mine_, last = all ? blocks_.size() : last_mine_;
    team_.for_each(last - first, [&](std::size_t n) { work(blocks_[first + n]); });
  }
  bool is_mine(const Block& block) const {
    return ranks_.is_alone() || (first_mine_ <= block.number && block.number < last_mine_);
  }
  /// Returns the rank that computes a block.
  int owner(std::size_t block) const { return owners_[block]; }

  /// Says that all blocks must be up to date before each step, in every rank.
  void keep_whole() { keeps_whole_ = true; }
  /// Prepares an evaluation of forces.
  void prepare() {
    if (keeps_whole_) gather();
  }
  /// Returns whether all blocks are up to date in every rank.
  bool is_whole() const { return ranks_.is_alone() || whole_ == Whole::everywhere; }
  /// Brings all blocks up to date in every rank. All ranks must call it.
  void gather();
  /// Brings all blocks up to date in the first rank. All ranks must call it.
  void gather_in_first();
  /// Copies numbers of `count` particles from `first` on to the first rank, each from the rank that
  /// moves the particle. `values`: so many `components` of each particle.
  void collect(Particle first, std::uint64_t count, std::size_t components,
               std::span<double> values);
  /// Copies to every rank what the last evaluation found for rows and boundary particles.
  void gather_results();
  /// Meets the other ranks after each has moved its own blocks, and gets the rows of others that it
  /// reads, and all notes for the field of damage. Returns the largest number of springs that broke
  /// and of notes in a rank.
  std::int64_t exchange_ranks();
  /// Copies the breakages of this step to every rank.
  void gather_broken();

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
  /// blocks. All ranks restore. The first rank saves while the others call pass_to_first(); it gets
  /// their blocks in pieces, which go into the archive at once.
  void archive(Archive& archive);
  /// Saves or restores the blocks without what loads do in them.
  void archive_body(Archive& archive);
  /// Passes the blocks of this rank to the first one, which saves them.
  void pass_to_first();

 private:
  /// Where all blocks are up to date.
  enum class Whole : std::uint8_t { nowhere, in_first, everywhere };
  /// Copies parts of each block from the rank that computes it, to all ranks or to the first.
  template <class Parts>
  void spread(const Parts& parts, bool to_all = true);
  void gather(Whole where);
  void visit_all(Archive& archive, Block& block) const;
  /// Returns whether this rank has a block that another one computes only to pass it on.
  bool is_passed(const Block& block) const {
    return !ranks_.is_alone() && whole_ == Whole::nowhere && owners_[block.number] != 0;
  }
  void pass(Block& block);
  void take(Archive& archive, const Block& block);
  void restore(Archive& archive);
  void allocate(Block& block, std::size_t number);
  void allocate_motion(Block& block, bool at_once) const;
  void fill(Block& block) const;
  void add_supports(Block& block) const;
  void set_start_velocities() const;
  void find_first_of_ranks();

  const Model& model_;
  std::unique_ptr<Layout> layout_;
  std::vector<Block> blocks_;
  mutable Team team_;  // reading the state in parallel does not change it
  Ranks& ranks_;
  std::vector<int> owners_;              // rank of each block
  std::vector<Particle> first_of_rank_;  // and the number of particles; empty: there is one rank
  std::size_t first_mine_ = 0, last_mine_ = 0;
  std::optional<Halo> halo_;  // none: there are no other ranks
  bool keeps_whole_ = false;
  Whole whole_ = Whole::everywhere;
};

}  // namespace hyperlattice
