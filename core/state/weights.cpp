#include <base/errors.hpp>
#include <state/weights.hpp>

#include <algorithm>
#include <limits>

namespace hyperlattice {
namespace {

constexpr std::size_t cells_of_row = lanes + 1;

constexpr std::size_t row_of(int dj, int dk) {
  const int row = 2 * (dk + 1) + dj + 1;
  return static_cast<std::size_t>(row);
}

}  // namespace

std::size_t WeightSets::Hash::operator()(const Around& around) const {
  std::size_t hash = 0;
  for (const float share : around)
    hash = (hash ^ std::hash<float>()(share)) * std::size_t{0x9E3779B97F4A7C15} + (hash >> 29);
  return hash;
}

void WeightSets::add_row(const Body& body, std::int32_t j, std::int32_t k, const Row& row,
                         std::uint64_t vectors, std::vector<std::uint32_t>& places) {
  if (body.cells.empty()) return;
  if (vectors_.empty()) {
    Around whole;
    whole.fill(1);
    place(body, whole);  // whole_set
  }
  std::vector<Around> around(vectors, Around{});
  for_cells_of({}, [&](int di, int dj, int dk) {
    if (di != 0) return;  // only one row of cells for each (dj, dk)
    for (const Run& run : body.cells.row(j + dj, k + dk))
      for (std::int32_t cell = std::max(run.begin, row.begin - 1);
           cell < std::min(run.end, row.end); ++cell) {
        const std::int32_t ahead = cell - row.begin + 1;  // in the first vector
        const auto t = static_cast<std::size_t>(ahead);
        const auto share = static_cast<float>(
            body.cells.share_of_cell(run.first + static_cast<Particle>(cell - run.begin)));
        const auto set = [&](std::size_t vector, std::size_t place) {
          if (vector < around.size()) around[vector][cells_of_row * row_of(dj, dk) + place] = share;
        };
        set(t / lanes, t % lanes);
        // A cell between two vectors touches both.
        if (t % lanes == 0 && t > 0) set(t / lanes - 1, lanes);
      }
  });
  for (const Around& cells : around) places.push_back(place(body, cells));
}

std::uint32_t WeightSets::place(const Body& body, const Around& around) {
  const auto [known, is_new] =
      places_.try_emplace(around, static_cast<std::uint32_t>(vectors_.size() * lanes));
  if (!is_new) return known->second;
  if (vectors_.size() * lanes > std::numeric_limits<std::uint32_t>::max())
    throw OutsideError(
        "too many partial cells at the surface: kernels count their weights in 32 bits");
  const auto add = [&](const Neighbour& to) {
    Vector& shares = vectors_.emplace_back();
    for (int lane = 0; lane < lanes; ++lane)
      shares.values[lane] = mean_share(to, [&](int di, int dj, int dk) {
        return double{
            around[cells_of_row * row_of(dj, dk) + static_cast<std::size_t>(lane + di + 1)]};
      });
  };
  add({});
  for (double& share : vectors_.back().values)
    // A site without a particle must not have zero mass.
    if (share == 0) share = 1;
  for (const Neighbour& to : body.neighbours) add(to);
  return known->second;
}

}  // namespace hyperlattice
