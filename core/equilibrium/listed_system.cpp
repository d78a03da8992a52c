#include <equilibrium/listed_system.hpp>

namespace hyperlattice::equilibrium {

ListedSystem::ListedSystem(const StaticProblem& problem)
    : System(problem),
      grid_(problem.grid),
      components_(static_cast<std::size_t>(grid_.components)),
      block_size_(components_ * components_),
      volumes_(problem) {
  axial_.resize(grid_.springs.size());
  pull_.resize(grid_.springs.size());
  if (components_ == 4) {
    cross_axial_.resize(grid_.springs.size());
    cross_pull_.resize(grid_.springs.size());
  }
  if (grid_.has_own()) own_.resize(grid_.numbers());
  find_pattern();
}

void ListedSystem::find_pattern() {
  std::vector<std::vector<std::int64_t>> neighbours(static_cast<std::size_t>(grid_.places));
  for (std::int64_t p = 0; p < grid_.places; ++p)
    neighbours[static_cast<std::size_t>(p)].push_back(p);
  for (const StaticSpring& spring : grid_.springs) {
    neighbours[static_cast<std::size_t>(spring.a)].push_back(spring.b);
    neighbours[static_cast<std::size_t>(spring.b)].push_back(spring.a);
  }
  for (std::int64_t p = 0; p < grid_.places && !volumes_.empty(); ++p) {
    const std::span<const std::int64_t> around = volumes_.around(p);
    for (const std::int64_t place : around) {
      auto& row = neighbours[static_cast<std::size_t>(place)];
      row.insert(row.end(), around.begin(), around.end());
    }
  }
  first_.push_back(0);
  for (auto& row : neighbours) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    column_.insert(column_.end(), row.begin(), row.end());
    first_.push_back(column_.size());
  }
  blocks_.resize(column_.size() * block_size_);
}

std::size_t ListedSystem::find(std::int64_t row, std::int64_t column) const {
  const auto from =
      column_.begin() + static_cast<std::ptrdiff_t>(first_[static_cast<std::size_t>(row)]);
  const auto to =
      column_.begin() + static_cast<std::ptrdiff_t>(first_[static_cast<std::size_t>(row) + 1]);
  return static_cast<std::size_t>(std::lower_bound(from, to, column) - column_.begin());
}

SpringNumbers ListedSystem::numbers_of(std::size_t s) const {
  return components_ == 4 ? SpringNumbers{axial_[s], pull_[s], cross_axial_[s], cross_pull_[s]}
                          : SpringNumbers{axial_[s], pull_[s], 0, 0};
}

double ListedSystem::linearise(const Field& displacement, Field& force) {
  SpringTangents tangents{axial_.data(), pull_.data()};
  if (components_ == 4) {
    tangents.cross_axial = cross_axial_.data();
    tangents.cross_pull = cross_pull_.data();
  }
  if (grid_.has_own()) tangents.own = own_.data();
  if (!volumes_.empty()) volumes_.receive(tangents);
  const double energy = problem().respond(displacement.data(), force.data(), &tangents);
  assemble(displacement);
  return energy;
}

void ListedSystem::assemble(const Field& u) {
  std::fill(blocks_.begin(), blocks_.end(), 0.0);
  const bool heights = components_ == 4;
  for (std::size_t s = 0; s < grid_.springs.size(); ++s) {
    const StaticSpring& spring = grid_.springs[s];
    const auto at = [&](std::int64_t c, std::int64_t place) {
      return u[static_cast<std::size_t>(c * grid_.places + place)];
    };
    const auto apart = [&](std::int64_t c) { return at(c, spring.b) - at(c, spring.a); };
    const auto in_spacings = [&](double length) {
      return static_cast<float>(length / grid_.spacing);
    };
    const float r[4] = {in_spacings(spring.rest.x + apart(0)),
                        in_spacings(spring.rest.y + apart(1)),
                        in_spacings(spring.rest.z + apart(2)), heights ? in_spacings(apart(3)) : 0};
    const float total =
        heights ? in_spacings(grid_.membrane_distance + at(3, spring.a) + at(3, spring.b)) : 0;
    const SpringBlocks tangent(numbers_of(s), r, total, heights);
    const std::int64_t ends[2] = {spring.a, spring.b};
    for (int e = 0; e < 2; ++e)
      for (int f = 0; f < 2; ++f) {
        double* to = block(find(ends[e], ends[f]));
        const double across = e == f ? 1 : -1;
        for (std::size_t a = 0; a < components_; ++a)
          for (std::size_t b = 0; b < components_; ++b) {
            // in a cross spring the heights of both ends add up
            const double sign = (a < 3 && e == 0 ? -1.0 : 1.0) * (b < 3 && f == 0 ? -1.0 : 1.0);
            to[a * components_ + b] +=
                across * tangent.base[4 * a + b] + sign * tangent.cross[4 * a + b];
          }
      }
  }
  for (std::int64_t p = 0; !own_.empty() && p < grid_.places; ++p)
    for (std::size_t c = 0; c < components_; ++c)
      block(find(p, p))[c * (components_ + 1)] += static_cast<double>(
          own_[c * static_cast<std::size_t>(grid_.places) + static_cast<std::size_t>(p)]);
  if (!volumes_.empty()) add_volumes(u);
}

void ListedSystem::add_volumes(const Field& u) {
  volumes_.for_blocks(u, [&](std::int64_t from, std::int64_t to, const VolumeBlock& volume) {
    double* const own = block(find(from, to));
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) own[a * components_ + b] += volume[3 * a + b];
  });
}

void ListedSystem::multiply(const double* x, double* y) const {
  const auto places = static_cast<std::size_t>(grid_.places);
  in_pieces(places, threads(), [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      double sum[4] = {};
      for (std::size_t n = first_[p]; n < first_[p + 1]; ++n)
        for (std::size_t a = 0; a < components_; ++a)
          for (std::size_t b = 0; b < components_; ++b)
            sum[a] += block(n)[a * components_ + b] *
                      x[b * places + static_cast<std::size_t>(column_[n])];
      for (std::size_t a = 0; a < components_; ++a) y[a * places + p] = sum[a];
    }
  });
  mask(y);
}

void ListedSystem::mask(double* x) const {
  for (std::int64_t p = 0; p < grid_.places; ++p)
    for (int c = 0; c < grid_.components; ++c)
      if ((grid_.free[p] >> c & 1u) == 0) x[c * grid_.places + p] = 0;
}

bool ListedSystem::is_unknown(std::size_t number) const {
  const auto places = static_cast<std::size_t>(grid_.places);
  const std::size_t p = number % places, c = number / places;
  const auto place = static_cast<std::int64_t>(p);
  return (grid_.free[p] >> c & 1u) != 0 && block(find(place, place))[c * (components_ + 1)] > 0;
}

double ListedSystem::stiffest() const {
  return std::max(largest_magnitude(axial_), largest_magnitude(cross_axial_));
}

double ListedSystem::softest_height() const {
  double softest = infinity;
  for (std::int64_t p = 0; components_ == 4 && p < grid_.places; ++p)
    if ((grid_.free[p] >> 3 & 1u) != 0) softest = std::min(softest, block(find(p, p))[15]);
  return softest;
}

void ListedSystem::for_springs(const Join& join) const {
  for (std::size_t s = 0; s < grid_.springs.size(); ++s)
    if (const SpringNumbers n = numbers_of(s);
        n.axial != 0 || n.pull != 0 || n.cross_axial != 0 || n.cross_pull != 0)
      join(grid_.springs[s].a, grid_.springs[s].b);
}

}  // namespace hyperlattice::equilibrium
