// How the springs of a structured body are found, named and removed in its blocks.
#include <state/block.hpp>
#include <state/grid_layout.hpp>

namespace hyperlattice {

SpringEnds GridLayout::spring(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                              std::int32_t site) const {
  Site here = first_site_of_row(block.number, row);
  here.i = site;
  const Neighbour& to = model_.body.neighbours[neighbour];
  return {model_.body.at(here), model_.body.at({here.i + to.dx, here.j + to.dy, here.k + to.dz}),
          neighbour, true};
}

std::optional<std::uint32_t> GridLayout::number_in_row(const Block& block, const Place& first,
                                                       std::uint32_t neighbour) const {
  if (!exists(block, first, neighbour)) return std::nullopt;
  return neighbour;
}

bool GridLayout::exists(const Block& block, const Place& first, std::uint32_t number) const {
  return (block.alive[first.index] >> number & 1U) != 0;
}

void GridLayout::remove(Block& block, std::uint32_t row, std::uint32_t neighbour,
                        std::int32_t site) const {
  const Row& of = block.rows[row];
  std::uint16_t& bits = block.alive[of.start + static_cast<std::uint64_t>(site - of.begin)];
  bits = static_cast<std::uint16_t>(bits & ~(1U << neighbour));
}

Layout::Memory GridLayout::memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                                  std::int32_t site, bool cross) const {
  const std::uint64_t sites = block.layout->sites,
                      before = kept_numbers() * neighbour + (cross ? model_.springs.memory : 0);
  const Row& of = block.rows[row];
  return {
      block.memory.get() + before * sites + of.start + static_cast<std::uint64_t>(site - of.begin),
      sites};
}

std::uint64_t GridLayout::other_end(std::size_t block, std::uint32_t row, std::uint32_t neighbour,
                                    std::int32_t site) const {
  const Neighbour& to = model_.body.neighbours[neighbour];
  const std::int32_t other_row =
      static_cast<std::int32_t>(row) + to.dz * model_.body.grid.sites[1] + to.dy;
  const Row& other = blocks[block].rows[static_cast<std::size_t>(other_row)];
  return other.start + static_cast<std::uint64_t>(site + to.dx - other.begin);
}

double GridLayout::rate(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                        std::int32_t site) const {
  const Row& of = block.rows[row];
  const std::uint64_t a = of.start + static_cast<std::uint64_t>(site - of.begin),
                      b = other_end(block.number, row, neighbour, site);
  const Vec3 rest = model_.springs.neighbours[neighbour].rest;
  double squared_length = 0, product = 0;
  for (int c = 0; c < model_.degrees_of_freedom; ++c) {
    const double apart =
        (c < 3 ? rest[c] : 0) + (block.displacement[c][b] - block.displacement[c][a]);
    squared_length += apart * apart;
    product += apart * (block.velocity[c][b] - block.velocity[c][a]);
  }
  return product / std::sqrt(squared_length);
}

void GridLayout::for_springs(const Block& block,
                             const std::function<void(const SpringPlace&)>& visit) const {
  for (std::uint32_t r = 0; r < block.rows.size(); ++r) {
    const Row& row = block.rows[r];
    for (std::uint32_t n = 0; n < model_.body.neighbours.size(); ++n)
      for (std::int32_t i = row.begin; i < row.end; ++i) {
        const std::uint64_t place = row.start + static_cast<std::uint64_t>(i - row.begin);
        if ((block.alive[place] >> n & 1U) == 0) continue;
        visit({r, n, i, spring(block, r, n, i),
               r >= block.layout->first_own && r < block.layout->last_own});
      }
  }
}

void GridLayout::for_springs_beyond(const Block& block, std::span<const GrowthBounds> bounds,
                                    const std::function<void(const SpringPlace&)>& visit) const {
  for (std::uint32_t r = block.layout->first_own; r < block.layout->last_own; ++r) {
    const Row& row = block.rows[r];
    for (std::uint32_t n = 0; n < model_.springs.neighbours.size(); ++n) {
      if ((row.neighbours >> n & 1U) == 0) continue;
      const Vec3 twice = 2 * model_.springs.neighbours[n].rest;
      const auto [least, most] = bounds[n];
      // The other ends of a row's springs are as far apart as the sites.
      const std::uint64_t other = other_end(block.number, r, n, row.begin);
      for (std::int32_t i = row.begin; i < row.end; ++i) {
        const auto along = static_cast<std::uint64_t>(i - row.begin);
        const std::uint64_t here = row.start + along, there = other + along;
        if ((block.alive[here] >> n & 1U) == 0) continue;
        const auto apart = [&](int c) {
          return block.displacement[c][there] - block.displacement[c][here];
        };
        const Vec3 d{apart(0), apart(1), apart(2)};
        double growth = dot(d, twice + d);
        if (model_.degrees_of_freedom == 4) growth += apart(3) * apart(3);
        if (growth > least && growth <= most) continue;
        visit({r, n, i, spring(block, r, n, i)});
      }
    }
  }
}

}  // namespace hyperlattice
