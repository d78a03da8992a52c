// The weights of particles and springs in a body of cells, as kernels read them: one set for each
// vector of sites. Vectors with the same arrangement of cells share a set, so that a body has few
// sets and its inside has one.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/kernel_request.hpp>

#include <unordered_map>
#include <vector>

namespace hyperlattice {

class WeightSets {
 public:
  /// Appends the index in values() of the set of each of `vectors` vectors of `lanes` sites, from
  /// the row's first site on. Does nothing if the body has no cells.
  void add_row(const Body& body, std::int32_t j, std::int32_t k, const Row& row,
               std::uint64_t vectors, std::vector<std::uint32_t>& places);

  const double* values() const { return vectors_.empty() ? nullptr : vectors_.front().values; }
  double bytes() const { return static_cast<double>(vectors_.size() * sizeof(Vector)); }

 private:
  struct alignas(64) Vector {
    double values[lanes];
  };
  std::uint32_t place(const Body& body, std::uint64_t cells);

  /// Each set: fractions of the particles, then of their springs to each neighbour.
  std::vector<Vector> vectors_;
  std::unordered_map<std::uint64_t, std::uint32_t> places_;
};

}  // namespace hyperlattice
