#include <state/weights.hpp>

#include <algorithm>

namespace hyperlattice {
namespace {

// A vector of sites touches four rows of lanes + 1 cells, which begin left of its first site. Each
// cell has one bit.
constexpr int cells_of_row = lanes + 1;

int row_of(int dj, int dk) { return 2 * (dk + 1) + dj + 1; }

}  // namespace

void WeightSets::add_row(const Body& body, std::int32_t j, std::int32_t k, const Row& row,
                         std::uint64_t vectors, std::vector<std::uint32_t>& places) {
  if (body.cells.empty()) return;
  if (vectors_.empty())
    place(body, (std::uint64_t{1} << 4 * cells_of_row) - 1);  // all cells: whole_set
  std::vector<std::uint64_t> around(vectors, 0);
  for_cells_of({}, [&](int di, int dj, int dk) {
    if (di != 0) return;  // only one row of cells for each (dj, dk)
    for (const Run& run : body.cells.row(j + dj, k + dk))
      for (std::int32_t cell = std::max(run.begin, row.begin - 1);
           cell < std::min(run.end, row.end); ++cell) {
        const std::int32_t t = cell - row.begin + 1;  // its bit in the row's first vector
        const auto mark = [&](std::int32_t vector, std::int32_t bit) {
          if (vector >= 0 && static_cast<std::size_t>(vector) < around.size())
            around[static_cast<std::size_t>(vector)] |= std::uint64_t{1}
                                                        << (cells_of_row * row_of(dj, dk) + bit);
        };
        mark(t / lanes, t % lanes);
        // A cell between two vectors touches both.
        if (t % lanes == 0) mark(t / lanes - 1, lanes);
      }
  });
  for (const std::uint64_t cells : around) places.push_back(place(body, cells));
}

std::uint32_t WeightSets::place(const Body& body, std::uint64_t cells) {
  const auto [known, is_new] =
      places_.try_emplace(cells, static_cast<std::uint32_t>(vectors_.size() * lanes));
  if (!is_new) return known->second;
  const auto add = [&](const Neighbour& to) {
    Vector& shares = vectors_.emplace_back();
    for (int lane = 0; lane < lanes; ++lane)
      shares.values[lane] = mean_share(to, [&](int di, int dj, int dk) {
        return (cells >> (cells_of_row * row_of(dj, dk) + lane + di + 1) & 1u) != 0 ? 1.0 : 0.0;
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
