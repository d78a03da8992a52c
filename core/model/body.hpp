// The body: the places of the particles and the springs between them. A structured body has sites
// of a grid; a listed body has a list of particles and springs.
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

/// The springs of a particle of a structured body that were cut from the start: bit n is set if the
/// spring to neighbour n was.
struct CutSite {
  Particle particle = 0;
  std::uint32_t neighbours = 0;
};

struct Body {
  /// Its neighbours point into `neighbours`. A listed body sets only spacing, volume, membrane
  /// distance and shape.
  Grid grid;
  std::vector<Neighbour> neighbours;
  std::vector<Run> runs;  ///< in the order z, y, x
  /// [k * ny + j]: first run of a row; one more entry at the end
  std::vector<std::size_t> row_runs;
  Cells cells;    ///< empty if the boundary is particles; has the share of each cell
  Listed listed;  ///< empty if the body is structured
  std::vector<CutSite> cut_sites;  ///< of a structured body, ascending; see cut_springs.hpp
  std::uint64_t particles = 0;
  std::uint64_t springs[max_spring_classes] = {};
  std::int32_t reach = 1;  ///< distance of the farthest neighbour along z, planes
  Site low, high;          ///< lowest and highest site of the box that the particles fill
  Vec3 lowest, highest;    ///< corners of the box around the positions of the particles, m

  bool is_listed() const { return !listed.empty(); }
  /// Returns whether the particles stand for cubic cells or are the corners of cubic cells.
  bool is_cubic() const { return !is_listed() && grid.basis == cubic_basis; }
  Vec3 position(Particle particle) const {
    return is_listed() ? listed.positions[particle] : position(site(particle));
  }  ///< at rest, metres
  /// Returns the share of a whole particle: 1, or less at the surface of a body of cells, or the
  /// value in the list.
  double share(Particle particle) const {
    if (is_listed()) return listed.shares.empty() ? 1 : listed.shares[particle];
    return share(site(particle));
  }
  /// Calls visit(a, b, spring class) for every base spring, a < b.
  template <class Visit>
  void for_springs(const Visit& visit) const;
  /// Calls visit(a, b, neighbour) for every base spring that the lattice would have, but that was
  /// cut from the start. `neighbour`: of a structured body its index in `neighbours`, of a listed
  /// body its index in Listed::cut.
  template <class Visit>
  void for_cut_springs(const Visit& visit) const;
  /// Returns the number of springs that were cut from the start.
  std::uint64_t cut_springs() const;
  /// Takes springs away from a structured body; a particle may be named more than once.
  void take_away(std::vector<CutSite> cut);
  /// Takes springs away from a listed body: those whose entry, in the order of Listed::springs, is
  /// true.
  void take_away(const std::vector<bool>& is_cut);

  // The functions below, except base_springs(), are for structured bodies.
  Site site(Particle particle) const;
  Vec3 position(Site site) const {
    return grid.origin + grid.spacing * combined(grid.basis, site.i, site.j, site.k);
  }  ///< at rest, metres
  /// Returns the centre, m, of a cell, given its index in `cells`.
  Vec3 centre_of_cell(Particle cell) const;
  /// Returns the particle at a site, or no_particle.
  Particle at(Site site) const;
  static constexpr Particle no_particle = ~Particle{0};

  /// Returns the runs of a row; none outside the box.
  std::span<const Run> row(std::int32_t j, std::int32_t k) const;
  /// Returns whether the spring from a particle to a neighbour was cut from the start.
  bool is_cut(Particle particle, std::uint32_t neighbour) const {
    return !cut_sites.empty() && (cut_of(particle) >> neighbour & 1U) != 0;
  }
  /// Returns the ranges of sites in row (j, k) that have a spring to the neighbour, ascending and
  /// disjoint.
  std::vector<Range> springs_of(std::int32_t j, std::int32_t k, const Neighbour& to) const;
  /// Returns the same for the body without cuts.
  std::vector<Range> uncut_springs_of(std::int32_t j, std::int32_t k, const Neighbour& to) const;
  /// Returns the share of the spring from a site to the neighbour; with `to` {} the share of the
  /// particle at the site: 1, or less at the surface of a body of cells.
  double share(Site site, const Neighbour& to = {}) const {
    return cells.empty() ? 1 : cells.share(site, to);
  }
  std::uint64_t base_springs() const {
    std::uint64_t n = 0;
    for (auto s : springs) n += s;
    return n;
  }

 private:
  /// Returns CutSite::neighbours of a particle.
  std::uint32_t cut_of(Particle particle) const;
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

template <class Visit>
void Body::for_cut_springs(const Visit& visit) const {
  for (std::uint32_t n = 0; n < listed.cut.size(); ++n)
    visit(Particle{listed.cut[n].a}, Particle{listed.cut[n].b}, n);
  for (const CutSite& cut : cut_sites) {
    const Site from = site(cut.particle);
    for (std::uint32_t n = 0; n < neighbours.size(); ++n)
      if ((cut.neighbours >> n & 1U) != 0)
        visit(cut.particle,
              at({from.i + neighbours[n].dx, from.j + neighbours[n].dy, from.k + neighbours[n].dz}),
              n);
  }
}

/// Builds the body that a lattice component describes. Throws std::invalid_argument with the
/// component's sentence if the component refuses. `for_analysis`: only the elastic constants are
/// needed, see LatticeSink. `component`: the owner of the functions; null: the host.
Body build_body(const LatticeFunctions& functions, const void* lattice, bool for_analysis = false,
                const Component* component = nullptr);

}  // namespace hyperlattice
