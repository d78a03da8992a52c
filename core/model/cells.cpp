#include <model/cells.hpp>

#include <algorithm>

namespace hyperlattice {

Cells::Cells(std::vector<Run> runs, std::vector<std::size_t> row_runs, std::int32_t rows,
             std::vector<PartialCell> partial)
    : runs_(std::move(runs)),
      row_runs_(std::move(row_runs)),
      partial_(std::move(partial)),
      rows_(rows) {
  for (const Run& run : runs_) count_ += static_cast<std::uint64_t>(run.end - run.begin);
}

std::span<const Run> Cells::row(std::int32_t j, std::int32_t k) const {
  if (j < 0 || j >= rows_ || k < 0) return {};
  const std::size_t row =
      static_cast<std::size_t>(k) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(j);
  if (row + 1 >= row_runs_.size()) return {};
  return {runs_.data() + row_runs_[row], runs_.data() + row_runs_[row + 1]};
}

Particle Cells::at(Site cell) const {
  for (const Run& run : row(cell.j, cell.k))
    if (run.begin <= cell.i && cell.i < run.end)
      return run.first + static_cast<Particle>(cell.i - run.begin);
  return ~Particle{0};
}

double Cells::share_of_cell(Particle cell) const {
  const auto found =
      std::lower_bound(partial_.begin(), partial_.end(), cell,
                       [](const PartialCell& p, Particle wanted) { return p.cell < wanted; });
  return found == partial_.end() || found->cell != cell ? 1 : double{found->share};
}

double Cells::share_of_cell(Site cell) const {
  const Particle index = at(cell);
  return index == ~Particle{0} ? 0 : share_of_cell(index);
}

double Cells::volume() const {
  auto missing = 0.0;
  for (const PartialCell& partial : partial_) missing += 1 - double{partial.share};
  return static_cast<double>(count_) - missing;
}

double Cells::share(Site site, const Neighbour& to) const {
  return mean_share(to, [&](int di, int dj, int dk) {
    return share_of_cell(Site{site.i + di, site.j + dj, site.k + dk});
  });
}

std::vector<Range> Cells::sites(std::int32_t j, std::int32_t k, const Neighbour& to) const {
  std::vector<Range> found;
  for_cells_of(to, [&](int di, int dj, int dk) {
    for (const Run& run : row(j + dj, k + dk)) found.push_back({run.begin - di, run.end - di});
  });
  std::sort(found.begin(), found.end(),
            [](const Range& a, const Range& b) { return a.begin < b.begin; });
  std::vector<Range> apart;
  for (const Range& range : found) {
    if (!apart.empty() && range.begin <= apart.back().end)
      apart.back().end = std::max(apart.back().end, range.end);
    else
      apart.push_back(range);
  }
  return apart;
}

}  // namespace hyperlattice
