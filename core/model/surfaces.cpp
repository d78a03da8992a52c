#include <model/surfaces.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::array<Site, 6> steps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};  // as face_normals

Site beside(Site site, std::size_t face) {
  return {site.i + steps[face].i, site.j + steps[face].j, site.k + steps[face].k};
}

}  // namespace

Surfaces::Surfaces(const Body& body)
    : body_(body),
      widened_{body.grid.sites[0] + std::int64_t{2}, body.grid.sites[1] + std::int64_t{2},
               body.grid.sites[2] + std::int64_t{2}} {}

void Surfaces::flood() const {
  const auto [nx, ny, nz] = widened_;
  const auto size = static_cast<std::size_t>(nx * ny * nz);
  std::vector<bool> blocked(size);  // an existing cell, or one that the flood fill has reached
  for (const Run& run : body_.cells.empty() ? std::span(body_.runs) : body_.cells.runs()) {
    const auto row = static_cast<std::size_t>(((run.k + 1) * ny + run.j + 1) * nx + 1);
    std::fill(blocked.begin() + static_cast<std::ptrdiff_t>(row) + run.begin,
              blocked.begin() + static_cast<std::ptrdiff_t>(row) + run.end, true);
  }
  outside_.assign(size, false);
  std::vector<std::int64_t> front{0};  // a corner of the widened box is outside
  blocked[0] = outside_[0] = true;
  while (!front.empty()) {
    const std::int64_t here = front.back();
    front.pop_back();
    const std::int64_t i = here % nx, j = here / nx % ny, k = here / (nx * ny);
    const auto reach = [&](bool inside_box, std::int64_t place) {
      if (!inside_box || blocked[static_cast<std::size_t>(place)]) return;
      blocked[static_cast<std::size_t>(place)] = outside_[static_cast<std::size_t>(place)] = true;
      front.push_back(place);
    };
    reach(i > 0, here - 1);
    reach(i + 1 < nx, here + 1);
    reach(j > 0, here - nx);
    reach(j + 1 < ny, here + nx);
    reach(k > 0, here - nx * ny);
    reach(k + 1 < nz, here + nx * ny);
  }
}

bool Surfaces::is_outside(Site site) const {
  if (outside_.empty()) flood();
  return outside_[static_cast<std::size_t>(((site.k + 1) * widened_[1] + site.j + 1) * widened_[0] +
                                           site.i + 1)];
}

OpenFaces Surfaces::faces(Site cell) const {
  OpenFaces open = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    const Site other = beside(cell, face);
    const bool covered =
        body_.cells.empty() ? body_.at(other) != Body::no_particle : body_.cells.holds(other);
    if (!covered) open |= 1U << face;
  }
  return open;
}

OpenFaces Surfaces::outer_faces(Site cell) const {
  OpenFaces open = 0;
  for (std::size_t face = 0; face < 6; ++face)
    if (is_outside(beside(cell, face))) open |= 1U << face;
  return open;
}

OpenFaces Surfaces::inner_faces(Site cell) const { return faces(cell) & ~outer_faces(cell); }

}  // namespace hyperlattice
