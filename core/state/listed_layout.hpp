// The layout of a listed body: blocks of whole rows. A row is a range of particles, of the same
// length wherever blocks are cut. Behind its own particles a block keeps ghosts: copies of the
// particles in other blocks that its springs lead to.
#pragma once

#include <state/layout.hpp>

namespace hyperlattice {

class ListedLayout final : public Layout {
 public:
  ListedLayout(const Model& model, int threads);

  Place place(Particle particle) const override;
  void for_stretches(const std::function<void(const Stretch&)>& visit) const override;
  SpringEnds spring(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                    std::int32_t site) const override;
  std::optional<std::uint32_t> number_in_row(const Block& block, const Place& first,
                                             std::uint32_t neighbour) const override;
  bool exists(const Block& block, const Place& first, std::uint32_t number) const override;
  void remove(Block& block, std::uint32_t row, std::uint32_t neighbour,
              std::int32_t site) const override;
  Memory memory(const Block& block, std::uint32_t row, std::uint32_t slot, std::int32_t site,
                bool cross) const override;
  std::uint64_t other_end(std::size_t block, std::uint32_t row, std::uint32_t neighbour,
                          std::int32_t site) const override;
  double rate(const Block& block, std::uint32_t row, std::uint32_t neighbour,
              std::int32_t site) const override;
  void for_springs(const Block& block,
                   const std::function<void(const SpringPlace&)>& visit) const override;
  void for_springs_beyond(const Block& block, std::span<const GrowthBounds> bounds,
                          const std::function<void(const SpringPlace&)>& visit) const override;
  std::uint64_t alive_bits(const Block& block, std::uint64_t index) const override;
  void fill(Block& block) const override;
  void exchange(const std::vector<Block>& all, Block& block) const override;
  std::vector<Borrowed> borrowed(std::size_t block) const override;
  void describe(const Block& block, KernelRequest& request) const override;
  double state_bytes() const override;
  std::size_t scratch_numbers() const override;

 private:
  /// Copies the velocities of the block's particles and ghosts, before any of them changes.
  void exchange_velocities(const std::vector<Block>& all, Block& block) const;

  static constexpr std::uint64_t row_length = Listed::stretch;  ///< particles

  const std::uint64_t width_;  ///< particles in a pack, one a lane
  /// At both ends of the springs of each row of the body; empty if all rows have one law.
  const std::vector<Materials> materials_of_rows_;

  /// A block's particles [first, last) and the slots of their springs.
  struct Part {
    Particle first = 0, last = 0;
    std::vector<std::uint32_t>
        first_slot;  ///< first slot of each pack of particles, and the end of the last
    std::vector<Particle> ghosts;  ///< ascending

    bool holds(Particle particle) const { return particle >= first && particle < last; }
  };

  Part make_part(Particle first, Particle last, const std::vector<std::uint32_t>& springs_of) const;
  std::vector<Materials> materials_of_rows() const;
  std::int32_t law_of_row(std::int32_t material, std::uint64_t row) const;
  BlockLayout make_block(const Part& part) const;
  std::uint64_t padded(std::uint64_t particles) const {
    return (particles + width_ - 1) / width_ * width_;
  }
  std::size_t slot_lanes(const Part& part) const { return part.first_slot.back() * width_; }
  std::size_t neighbours(const Part& part) const { return slot_lanes(part) + slots_ahead * width_; }
  std::int32_t material_of_row(Particle first, Particle last) const;
  void fill_records(Block& block) const;
  void fill_springs(Block& block) const;
  bool has_own_stiffness() const;
  std::uint32_t record_of(const Part& part, Particle particle) const;
  Particle particle_of(const Part& part, std::uint32_t place) const;

  std::vector<Part> parts_;
};

}  // namespace hyperlattice
