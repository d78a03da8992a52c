#include <model/surfaces.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::array<Site, 6> steps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};  // as face_normals

Site beside(Site site, std::size_t face) {
  return {site.i + steps[face].i, site.j + steps[face].j, site.k + steps[face].k};
}

std::int32_t along(Site site, std::size_t axis) {
  return axis == 0 ? site.i : axis == 1 ? site.j : site.k;
}

}  // namespace

Surfaces::Surfaces(const Body& body)
    : body_(body),
      widened_{body.grid.sites[0] + std::int64_t{2}, body.grid.sites[1] + std::int64_t{2},
               body.grid.sites[2] + std::int64_t{2}} {}

double Surfaces::share(Site cell) const {
  if (!body_.cells.empty()) return body_.cells.share_of_cell(cell);
  return body_.at(cell) != Body::no_particle ? 1 : 0;
}

/// Two fills, each from a front of cells through their faces: the first finds the empty cells
/// outside, the second carries outside and cavity layer by layer into the partial cells.
void Surfaces::flood() const {
  const std::int64_t nx = widened_[0], ny = widened_[1], nz = widened_[2];
  const auto size = static_cast<std::size_t>(nx * ny * nz);
  std::vector<bool> blocked(size);  // an existing cell, or one that a fill has reached
  const auto place = [&](Site cell) {
    return ((cell.k + 1) * widened_[1] + cell.j + 1) * widened_[0] + cell.i + 1;
  };
  const auto for_cells = [&](const auto& visit) {
    for (const Run& run : body_.cells.empty() ? std::span(body_.runs) : body_.cells.runs())
      for (Site cell{run.begin, run.j, run.k}; cell.i < run.end; ++cell.i) visit(cell);
  };
  for_cells([&](Site cell) { blocked[static_cast<std::size_t>(place(cell))] = true; });
  // Calls reach(place) for each cell beside one that is not blocked, which then is.
  const auto spread = [&](std::int64_t here, const auto& reach) {
    const std::int64_t i = here % nx, j = here / nx % ny, k = here / (nx * ny);
    const auto try_at = [&](bool inside_box, std::int64_t next) {
      if (!inside_box || blocked[static_cast<std::size_t>(next)]) return;
      blocked[static_cast<std::size_t>(next)] = true;
      reach(next);
    };
    try_at(i > 0, here - 1);
    try_at(i + 1 < nx, here + 1);
    try_at(j > 0, here - nx);
    try_at(j + 1 < ny, here + nx);
    try_at(k > 0, here - nx * ny);
    try_at(k + 1 < nz, here + nx * ny);
  };
  outside_.assign(size, false);
  std::vector<std::int64_t> front{0};  // a corner of the widened box is outside
  blocked[0] = outside_[0] = true;
  while (!front.empty()) {
    const std::int64_t here = front.back();
    front.pop_back();
    spread(here, [&](std::int64_t next) {
      outside_[static_cast<std::size_t>(next)] = true;
      front.push_back(next);
    });
  }
  if (!body_.cells.has_partial()) return;
  // Empty cells beside the body begin; then only partial cells are open to the fill.
  blocked.assign(size, true);
  std::vector<Site> partial;
  for_cells([&](Site cell) {
    if (share(cell) < 1) partial.push_back(cell);
  });
  for (const Site cell : partial) {
    blocked[static_cast<std::size_t>(place(cell))] = false;
    for (std::size_t face = 0; face < steps.size(); ++face)
      if (const Site next = beside(cell, face); share(next) == 0) front.push_back(place(next));
  }
  // The outside comes first, so that it takes cells that are as near to a cavity.
  std::stable_partition(front.begin(), front.end(), [&](std::int64_t empty) {
    return bool{outside_[static_cast<std::size_t>(empty)]};
  });
  for (std::size_t n = 0; n < front.size(); ++n)
    spread(front[n], [&](std::int64_t next) {
      outside_[static_cast<std::size_t>(next)] = outside_[static_cast<std::size_t>(front[n])];
      front.push_back(next);
    });
}

bool Surfaces::is_outside(Site site) const {
  if (outside_.empty()) flood();
  return outside_[static_cast<std::size_t>(((site.k + 1) * widened_[1] + site.j + 1) * widened_[0] +
                                           site.i + 1)];
}

double Surfaces::open_part(Site cell, int direction) const {
  return std::max(0.0, share(cell) - share(beside(cell, static_cast<std::size_t>(direction))));
}

OpenFaces Surfaces::faces(Site cell) const {
  OpenFaces open = 0;
  const double own = share(cell);
  for (std::size_t face = 0; face < steps.size(); ++face)
    if (own > share(beside(cell, face))) open |= 1U << face;
  return open;
}

OpenFaces Surfaces::outer_faces(Site cell) const {
  OpenFaces open = faces(cell);
  for (std::size_t face = 0; face < 6; ++face)
    if ((open >> face & 1U) != 0 && !is_outside(beside(cell, face))) open &= ~(1U << face);
  return open;
}

bool Surfaces::ends_within_cells(int direction) const {
  auto& known = ends_within_[static_cast<std::size_t>(direction)];
  if (known) return *known;
  const auto axis = static_cast<std::size_t>(direction / 2);
  const Site last =
      direction % 2 == 0 ? body_.low : Site{body_.high.i - 1, body_.high.j - 1, body_.high.k - 1};
  bool any_whole = false;
  for (const Run& run : body_.cells.runs())
    for (Site cell{run.begin, run.j, run.k}; cell.i < run.end; ++cell.i)
      any_whole = any_whole || (along(cell, axis) == along(last, axis) && share(cell) == 1);
  known = !any_whole;
  return *known;
}

bool Surfaces::is_at_cut_end(Site site, int direction) const {
  if (!body_.cells.has_partial()) return false;
  const auto axis = static_cast<std::size_t>(direction / 2);
  const bool upwards = direction % 2 == 1;
  if (along(site, axis) != (upwards ? along(body_.high, axis) - 1 : along(body_.low, axis) + 1) ||
      !ends_within_cells(direction))
    return false;
  bool found = false;
  for_cells_of({}, [&](int di, int dj, int dk) {
    if ((along({di, dj, dk}, axis) == 0) != upwards) return;  // the outermost layer only
    const Site end{site.i + di, site.j + dj, site.k + dk},
        behind = beside(end, static_cast<std::size_t>(direction ^ 1));
    found = found || (share(end) > 0 && share(end) < share(behind));
  });
  return found;
}

OpenFaces Surfaces::inner_faces(Site cell) const { return faces(cell) & ~outer_faces(cell); }

}  // namespace hyperlattice
