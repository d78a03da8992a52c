// The body: where particles are and which springs join them. Most bodies are structured: sites of a
// grid; others are listed.
#pragma once

#include <geometry/region.hpp>
#include <model/cells.hpp>
#include <model/listed.hpp>

#include <hyperlattice/lattice.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hyperlattice {

struct Component;  // host/host.hpp

struct Body {
  Grid grid;  ///< its neighbours point into `neighbours`; of a listed body spacing, volume,
              ///< membrane distance and shape only
  std::vector<Neighbour> neighbours;
  std::vector<Run> runs;  ///< in the order z, y, x
  std::vector<std::size_t>
      row_runs;   ///< [k * ny + j] first run of a row; one more entry at the end
  Cells cells;    ///< none if the boundary is particles
  Listed listed;  ///< empty if the body is structured
  std::uint64_t particles = 0;
  std::uint64_t springs[max_spring_classes] = {};
  std::int32_t reach = 1;  ///< planes that the farthest neighbour is away
  Site low, high;          ///< first and last site of the box of sites that the particles fill
  Vec3 lowest, highest;    ///< corners of the box in space that their places fill, metres

  bool is_listed() const { return !listed.empty(); }
  bool is_cubic() const {
    return !is_listed() && grid.basis == cubic_basis;
  }  ///< its particles stand for cubic cells, or are their corners
  Vec3 position(Particle particle) const {
    return is_listed() ? listed.positions[particle] : position(site(particle));
  }  ///< at rest, metres
  /// What counts of a particle: 1, or less at the surface of a body of cells, or what a list says.
  double share(Particle particle) const {
    if (is_listed()) return listed.shares.empty() ? 1 : listed.shares[particle];
    return share(site(particle));
  }
  /// Calls visit(a, b, spring class) for every base spring, a < b.
  template <class Visit>
  void for_springs(const Visit& visit) const;

  // of a structured body
  Site site(Particle particle) const;
  Vec3 position(Site site) const {
    return grid.origin + grid.spacing * combined(grid.basis, site.i, site.j, site.k);
  }                                          ///< at rest, metres
  Vec3 centre_of_cell(Particle cell) const;  ///< by its place in `cells`, metres
  /// The particle at a site, or no_particle.
  Particle at(Site site) const;
  static constexpr Particle no_particle = ~Particle{0};

  std::span<const Run> row(std::int32_t j,
                           std::int32_t k) const;  ///< its runs; none outside the box
  /// Ranges of sites of row (j, k) that a spring joins to the neighbour, ascending and apart.
  std::vector<Range> springs_of(std::int32_t j, std::int32_t k, const Neighbour& to) const;
  /// What counts of a spring from a site, or with `to` {} of the particle there: 1, or less at the
  /// surface of a body of cells.
  double share(Site site, const Neighbour& to = {}) const {
    return cells.empty() ? 1 : cells.share(site, to);
  }
  std::uint64_t base_springs() const {
    std::uint64_t n = 0;
    for (auto s : springs) n += s;
    return n;
  }
};

template <class Visit>
void Body::for_springs(const Visit& visit) const {
  for (const ListedSpring& spring : listed.springs)
    visit(Particle{spring.a}, Particle{spring.b}, 0U);
  for (const Run& run : runs)
    for (const Neighbour& to : neighbours)
      for (const Range& range : springs_of(run.j, run.k, to))
        for (std::int32_t i = std::max(run.begin, range.begin); i < std::min(run.end, range.end);
             ++i)
          visit(run.first + static_cast<Particle>(i - run.begin),
                at({i + to.dx, run.j + to.dy, run.k + to.dz}), to.spring_class);
}

/// Builds the body that a lattice component describes. Throws std::invalid_argument with the
/// component's sentence if it refuses. `for_analysis`: only what stands behind it is wanted, see
/// LatticeSink. `component`: whose functions they are; null: the host's own.
Body build_body(const LatticeFunctions& functions, const void* lattice, bool for_analysis = false,
                const Component* component = nullptr);

}  // namespace hyperlattice
