// The layout of a structured body: blocks of whole planes with ghost planes. Rows follow each other
// without gaps.
#pragma once

#include <state/layout.hpp>
#include <state/weights.hpp>

namespace hyperlattice {

class GridLayout final : public Layout {
 public:
  GridLayout(const Model& model, int threads);

  Place place(Particle particle) const override;
  void for_stretches(const std::function<void(const Stretch&)>& visit) const override;
  SpringEnds spring(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                    std::int32_t site) const override;
  std::optional<std::uint32_t> number_in_row(const Block& block, const Place& first,
                                             std::uint32_t neighbour) const override;
  bool exists(const Block& block, const Place& first, std::uint32_t number) const override;
  void remove(Block& block, std::uint32_t row, std::uint32_t neighbour,
              std::int32_t site) const override;
  Memory memory(const Block& block, std::uint32_t row, std::uint32_t neighbour, std::int32_t site,
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
  /// A block's planes [first, first + count) of the body, with `reach` ghost planes before and
  /// after.
  struct Planes {
    std::int32_t first = 0, count = 0;
  };
  /// Indices of a plane in a block. They are contiguous, and as many in every block with the plane.
  struct PlaneRange {
    std::uint64_t begin = 0, end = 0;
  };

  /// Returns the ghost planes of a block that are in the body.
  std::vector<std::int32_t> ghost_planes(std::size_t block) const;
  std::int32_t law_of_row(std::int32_t material, std::int32_t j, std::int32_t k) const;
  BlockLayout make_block(Planes planes, std::uint64_t padding);
  /// Returns how many places a row of so many sites takes, with the padding.
  std::uint64_t whole_vectors(std::int32_t sites) const;
  std::size_t block_of_plane(std::int32_t k) const;
  PlaneRange plane(std::size_t block, std::int32_t k) const;
  std::uint32_t row_of(std::size_t block, Site site) const;
  void fill_cells(const Block& block, const Row& row, Site site) const;
  void start_row(const Block& block, std::uint32_t row, Site site) const;
  Site first_site_of_row(std::size_t block, std::uint32_t row) const;

  std::vector<Planes> planes_;  ///< of each block
  WeightSets weights_;
  std::int32_t scratch_width_ = 0;
};

}  // namespace hyperlattice
