#include <equilibrium/tangent_rows.hpp>

#include <hyperlattice/chance.hpp>

#include <cstring>

namespace hyperlattice::equilibrium {

namespace {

std::uint64_t hash(const float* numbers, std::size_t size) {  // size is a multiple of eight
  std::uint64_t all[4] = {1, 2, 3, 4};
  for (std::size_t n = 0; n < size; n += 8) {
    std::uint64_t bits[4];
    std::memcpy(bits, numbers + n, sizeof bits);
    for (int lane = 0; lane < 4; ++lane) all[lane] = mixed_bits(all[lane] ^ bits[lane]);
  }
  return mixed_bits(mixed_bits(mixed_bits(all[0] ^ all[1]) ^ all[2]) ^ all[3]);
}

}  // namespace

void TangentRows::pack(const StaticGrid& grid, const SpringTangents& tangents, bool deformed) {
  std::vector<const float*> kinds{tangents.axial};
  if (grid.components == 4) kinds.push_back(tangents.cross_axial);
  if (deformed) kinds.push_back(tangents.pull);
  if (deformed && grid.components == 4) kinds.push_back(tangents.cross_pull);
  row_.assign(grid.rows.size(), -1);
  packed_.clear();
  std::unordered_multimap<std::uint64_t, std::int64_t> known;
  const auto sites = static_cast<std::size_t>(grid.sites[1]);
  for (std::size_t r = 0; r < grid.rows.size(); ++r) {
    const StaticRow& row = grid.rows[r];
    const std::int64_t first = grid.place(row.begin, static_cast<std::int64_t>(r % sites),
                                          static_cast<std::int64_t>(r / sites)),
                       count = row.end - row.begin;
    if (count == 0) continue;
    const std::size_t start = packed_.size();
    row_[r] = static_cast<std::int64_t>(start);
    for (std::int64_t t = 0; t < count; t += lanes)
      for (std::size_t n = 0; n < grid.neighbours.size(); ++n)
        for (const float* kind : kinds) {
          const float* from = kind + static_cast<std::int64_t>(n) * grid.places + first + t;
          const std::int64_t there = std::min<std::int64_t>(lanes, count - t);
          packed_.insert(packed_.end(), from, from + there);
          packed_.insert(packed_.end(), static_cast<std::size_t>(lanes - there), 0.0F);
        }
    if (deformed) continue;
    const std::size_t size = packed_.size() - start;
    const std::uint64_t sum = hash(packed_.data() + start, size);
    const auto [from, to] = known.equal_range(sum);
    const auto same = std::find_if(from, to, [&](const auto& other) {
      return static_cast<std::size_t>(other.second) + size <= start &&
             std::memcmp(packed_.data() + other.second, packed_.data() + start,
                         size * sizeof(float)) == 0;
    });
    if (same == to) {
      known.emplace(sum, row_[r]);
    } else {
      row_[r] = same->second;
      packed_.resize(start);
    }
  }
}

}  // namespace hyperlattice::equilibrium
