// What counts of the particles and springs of a body of cells, as kernels read it: for each vector
// of sites a set of weights. Vectors whose cells are arranged alike share one set, so that a body
// has few and those of its inside are one.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/kernel_request.hpp>

#include <unordered_map>
#include <vector>

namespace hyperlattice {

class WeightSets {
 public:
  /// Appends, for each of `vectors` of `lanes` sites from the row's first on, the place of its set
  /// in values(). Does nothing if the body has no cells.
  void add_row(const Body& body, std::int32_t j, std::int32_t k, const Row& row,
               std::uint64_t vectors, std::vector<std::uint32_t>& places);

  const double* values() const { return vectors_.empty() ? nullptr : vectors_.front().values; }
  double bytes() const { return static_cast<double>(vectors_.size() * sizeof(Vector)); }

 private:
  struct alignas(64) Vector {
    double values[lanes];
  };
  std::uint32_t place(const Body& body, std::uint64_t cells);

  std::vector<Vector>
      vectors_;  ///< a set: shares of the particles, then of their springs to each neighbour
  std::unordered_map<std::uint64_t, std::uint32_t> places_;
};

}  // namespace hyperlattice
