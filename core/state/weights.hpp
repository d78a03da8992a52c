// The weights of particles and springs in a body of cells, as kernels read them: one set for each
// vector of sites. Vectors with the same shares of cells have one set in common: a body of whole
// cells has few sets, and the inside of any body has one. At a surface of partial cells each vector
// has a set of its own.
#pragma once

#include <model/body.hpp>

#include <hyperlattice/kernel_request.hpp>

#include <array>
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
  /// Call this after the last row.
  void finish() { places_.clear(); }

 private:
  struct alignas(64) Vector {
    double values[lanes];
  };
  /// The shares of the cells around a vector: four rows of lanes + 1 cells, which begin left of the
  /// vector's first site. A float holds each share exactly.
  using Around = std::array<float, std::size_t{4} * (lanes + 1)>;
  struct Hash {
    std::size_t operator()(const Around& around) const;
  };
  std::uint32_t place(const Body& body, const Around& around);

  /// Each set: fractions of the particles, then of their springs to each neighbour.
  std::vector<Vector> vectors_;
  std::unordered_map<Around, std::uint32_t, Hash> places_;
};

}  // namespace hyperlattice
