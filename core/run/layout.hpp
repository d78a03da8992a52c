// How the body is stored: blocks of whole planes, one a thread, each with ghost planes; rows padded to whole vectors, nothing between them.
#pragma once

#include <model/model.hpp>
#include <run/weights.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice {

/// Planes [first, first + planes) of the body, with `reach` ghost planes before and after.
struct BlockLayout {
  std::int32_t first = 0, planes = 0;
  std::vector<Row> rows;                   ///< [(k - first + reach) * ny + j]; supports not yet filled in
  std::vector<std::uint32_t> weight_sets;  ///< see KernelRequest
  std::uint64_t sites = 0;                 ///< places in each array, with the padding

  /// Places of a plane: they are contiguous, and as many in every block that holds the plane.
  std::uint64_t plane_begin(const Body& body, std::int32_t k) const;
  std::uint64_t plane_end(const Body& body, std::int32_t k) const;
};

struct Layout {
  std::vector<BlockLayout> blocks;
  WeightSets weights;
  std::int32_t scratch_width = 0;

  Layout(const Model& model, int threads);

  std::size_t block_of_plane(std::int32_t k) const;
  double state_bytes(const Model& model) const;  ///< displacement, velocity, alive springs, materials, weights: exactly what is allocated
  double scratch_bytes(const Model& model) const;
};

/// Bits of the sites of row (j, k): which springs leave each site, and whether it holds a particle. Element t belongs to site row.begin + t.
void fill_alive(const Body& body, std::int32_t j, std::int32_t k, const Row& row, std::uint16_t* alive);

}  // namespace hyperlattice
