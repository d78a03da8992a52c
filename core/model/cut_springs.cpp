#include <model/cut_springs.hpp>
#include <model/model.hpp>
#include <model/segment_bins.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

namespace hyperlattice {

namespace {

/// Which particles a region has.
std::vector<bool> members(const Body& body, RegionIndex& regions, RegionId region) {
  std::vector<bool> has(body.particles, false);
  for (const Particle particle : regions.particles(region)) has[particle] = true;
  return has;
}

/// A spring of a grid that a cut crosses: `neighbour` is an index in Body::neighbours.
using Cross = std::function<void(Particle from, Particle to, std::uint32_t neighbour)>;

/// Finds the springs of a grid that cuts cross.
class GridCutter {
 public:
  explicit GridCutter(const Body& body) : body_(body) {
    for (const Neighbour& n : body.neighbours)
      longest_ = std::max(longest_, norm(body.grid.spacing * step_of(n)));
  }
  double longest() const { return longest_; }

  /// Calls cross(a, b, neighbour) for each spring that the piece crosses.
  void for_crossed(const FlatPiece& piece, const Cross& cross) const {
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::max(piece.low[axis], body_.lowest[axis]) - longest_;
      high[axis] = std::min(piece.high[axis], body_.highest[axis]) + longest_;
      if (low[axis] > high[axis]) return;
    }
    Site first, last;
    find_sites(low, high, first, last);
    for (std::int32_t k = first.k; k <= last.k; ++k)
      for (std::int32_t j = first.j; j <= last.j; ++j)
        for (const Run& run : body_.row(j, k))
          cross_run(piece, run, std::max(run.begin, first.i), std::min(run.end, last.i + 1), cross);
  }

  /// Calls cross for each spring between a member and another particle.
  void for_border(const std::vector<bool>& has, const Cross& cross) const {
    for (const Run& run : body_.runs)
      for (std::int32_t i = run.begin; i < run.end; ++i)
        for_springs({i, run.j, run.k}, [&](Particle a, Particle b, std::uint32_t n) {
          if (has[a] != has[b]) cross(a, b, n);
        });
  }

 private:
  Vec3 step_of(const Neighbour& n) const { return combined(body_.grid.basis, n.dx, n.dy, n.dz); }

  /// Finds the box of sites around the box between two corners.
  void find_sites(Vec3 low, Vec3 high, Site& first, Site& last) const {
    const Basis& a = body_.grid.basis;
    const double volume = dot(a[0], cross_product(a[1], a[2])) * body_.grid.spacing;
    const std::array<Vec3, 3> reciprocal{(1 / volume) * cross_product(a[1], a[2]),
                                         (1 / volume) * cross_product(a[2], a[0]),
                                         (1 / volume) * cross_product(a[0], a[1])};
    std::array<std::int32_t, 3> from{}, to{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double least = infinity, most = -infinity;
      for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 x{(corner & 1U) != 0 ? high.x : low.x, (corner & 2U) != 0 ? high.y : low.y,
                     (corner & 4U) != 0 ? high.z : low.z};
        const double at = dot(x - body_.grid.origin, reciprocal[axis]);
        least = std::min(least, at);
        most = std::max(most, at);
      }
      const double end = body_.grid.sites[axis];
      from[axis] = static_cast<std::int32_t>(std::clamp(std::floor(least), 0.0, end));
      to[axis] = static_cast<std::int32_t>(std::clamp(std::ceil(most), -1.0, end - 1));
    }
    first = {from[0], from[1], from[2]};
    last = {to[0], to[1], to[2]};
  }
  static Vec3 cross_product(Vec3 a, Vec3 b) { return hyperlattice::cross(a, b); }

  /// Visits the sites begin <= i < end of a run.
  void cross_run(const FlatPiece& piece, const Run& run, std::int32_t begin, std::int32_t end,
                 const Cross& cross) const {
    for (Site site{begin, run.j, run.k}; site.i < end; ++site.i) {
      const Vec3 here = body_.position(site);
      if (std::abs(piece.height(here)) > 1.5 * longest_) continue;
      for_springs(site, [&](Particle a, Particle b, std::uint32_t n) {
        const Vec3 there = here + body_.grid.spacing * step_of(body_.neighbours[n]);
        if (piece.crosses(here, there, body_.grid.spacing)) cross(a, b, n);
      });
    }
  }

  template <class Visit>
  void for_springs(Site site, const Visit& visit) const {
    const Particle a = body_.at(site);
    for (std::uint32_t n = 0; n < body_.neighbours.size(); ++n) {
      const Neighbour& to = body_.neighbours[n];
      const Particle b = body_.at({site.i + to.dx, site.j + to.dy, site.k + to.dz});
      if (b != Body::no_particle && body_.share(site, to) > 0) visit(a, b, n);
    }
  }

  const Body& body_;
  double longest_ = 0;
};

/// Calls cross(n) for each segment that the piece crosses.
template <class CrossSegment>
void for_crossed(const Body& body, const SegmentBins& bins, std::span<const Segment> segments,
                 const FlatPiece& piece, const CrossSegment& cross) {
  bins.for_near(piece.low, piece.high, [&](std::size_t n) {
    if (piece.crosses(body.position(segments[n].a), body.position(segments[n].b),
                      body.grid.spacing))
      cross(n);
  });
}

/// Returns how far a piece is from the box around the body's particles, m; 0 if it reaches into it.
double distance_of(const FlatPiece& piece, const Body& body) {
  double apart = 0, least = infinity, most = -infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double off =
        std::max({0.0, piece.low[axis] - body.highest[axis], body.lowest[axis] - piece.high[axis]});
    apart += off * off;
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    const double height = piece.height({(corner & 1U) != 0 ? body.highest.x : body.lowest.x,
                                        (corner & 2U) != 0 ? body.highest.y : body.lowest.y,
                                        (corner & 4U) != 0 ? body.highest.z : body.lowest.z});
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return std::max({std::sqrt(apart), least, -most});
}

/// Returns what was expected in place of a surface that crosses no spring.
std::string expected_crossing(const CutSurface& surface, const Body& body, double longest) {
  double distance = infinity;
  for (const FlatPiece& piece : surface.pieces)
    distance = std::min(distance, distance_of(piece, body));
  const auto text = [](Vec3 v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); };
  if (distance > 0)
    return fmt::format(
        "a surface that crosses springs; this one is {:.4g} m away from the particles, which stand "
        "between {} and {} m",
        distance, text(body.lowest), text(body.highest));
  return fmt::format(
      "a surface that crosses springs; this one passes between all of them: a larger one, or "
      "another place. The springs are up to {:.4g} m long",
      longest);
}

/// Counts the crossings of each piece of a cut, and reports surfaces that cross nothing.
class Report {
 public:
  Report(Model& model, Faults& faults, double longest)
      : model_(model), faults_(faults), longest_(longest) {}

  /// `crossings`: of each piece.
  void check(const Cut& cut, std::span<const std::uint64_t> crossings) {
    const auto none =
        static_cast<std::size_t>(std::count(crossings.begin(), crossings.end(), std::uint64_t{0}));
    if (none == crossings.size())
      faults_.add(cut.pointer, "", expected_crossing(cut.surface, model_.body, longest_));
    else if (cut.surface.is_list && none > 0)
      model_.warnings.push_back(fmt::format("{} of the {} surfaces of {} cross no spring", none,
                                            crossings.size(), cut.pointer));
  }
  void check_border(const Cut& cut, RegionIndex& regions, std::uint64_t crossings) {
    const RegionId region = *cut.surface.border_of;
    const std::size_t held = regions.particles(region).size();
    if (held == 0)
      faults_.add(cut.pointer, "", regions.expected_particles(region));
    else if (crossings == 0)
      faults_.add(
          cut.pointer, "",
          "a region that springs join to the rest of the body; no spring crosses its "
          "border" +
              std::string(held == model_.body.particles ? ", as it holds all particles" : ""));
  }

 private:
  Model& model_;
  Faults& faults_;
  double longest_;
};

void cut_grid(Model& model, std::span<const Cut> cuts, RegionIndex& regions, Faults& faults) {
  Body& body = model.body;
  const GridCutter cutter(body);
  Report report(model, faults, cutter.longest());
  std::vector<CutSite> found;
  for (const Cut& cut : cuts) {
    std::vector<std::uint64_t> crossings;
    const auto take = [&](Particle a, Particle, std::uint32_t n) {
      found.push_back({a, 1U << n});
      ++crossings.back();
    };
    if (cut.surface.border_of) {
      crossings.push_back(0);
      cutter.for_border(members(body, regions, *cut.surface.border_of), take);
      report.check_border(cut, regions, crossings.back());
      continue;
    }
    for (const FlatPiece& piece : cut.surface.pieces) {
      crossings.push_back(0);
      cutter.for_crossed(piece, take);
    }
    report.check(cut, crossings);
  }
  body.take_away(std::move(found));
}

std::vector<Segment> segments_of(const Listed& listed) {
  std::vector<Segment> segments;
  segments.reserve(listed.springs.size());
  for (const ListedSpring& spring : listed.springs)
    segments.push_back({Particle{spring.a}, Particle{spring.b}});
  return segments;
}

/// Calls visit(cut, counts) after each cut, whose crossings cross(segment) gets.
template <class CrossSegment, class AfterCut>
void cut_segments(const Body& body, std::span<const Cut> cuts, RegionIndex& regions,
                  std::span<const Segment> segments, const CrossSegment& cross,
                  const AfterCut& after) {
  const SegmentBins bins(body, segments);
  for (const Cut& cut : cuts) {
    std::vector<std::uint64_t> crossings;
    const auto take = [&](std::size_t n) {
      ++crossings.back();
      cross(n);
    };
    if (cut.surface.border_of) {
      const std::vector<bool> has = members(body, regions, *cut.surface.border_of);
      crossings.push_back(0);
      for (std::size_t n = 0; n < segments.size(); ++n)
        if (has[segments[n].a] != has[segments[n].b]) take(n);
    }
    for (const FlatPiece& piece : cut.surface.pieces) {
      crossings.push_back(0);
      for_crossed(body, bins, segments, piece, take);
    }
    after(cut, crossings, bins.longest());
  }
}

void cut_list(Model& model, std::span<const Cut> cuts, RegionIndex& regions, Faults& faults) {
  const std::vector<Segment> segments = segments_of(model.body.listed);
  std::vector<bool> is_cut(segments.size(), false);
  cut_segments(
      model.body, cuts, regions, segments, [&](std::size_t n) { is_cut[n] = true; },
      [&](const Cut& cut, std::span<const std::uint64_t> crossings, double longest) {
        Report report(model, faults, longest);
        if (cut.surface.border_of)
          report.check_border(cut, regions, crossings.front());
        else
          report.check(cut, crossings);
      });
  model.body.take_away(is_cut);
}

}  // namespace

std::vector<bool> crossed(const Body& body, std::span<const Cut> cuts, RegionIndex& regions,
                          std::span<const Segment> segments) {
  std::vector<bool> is_crossed(segments.size(), false);
  cut_segments(
      body, cuts, regions, segments, [&](std::size_t n) { is_crossed[n] = true; },
      [](const Cut&, std::span<const std::uint64_t>, double) {});
  return is_crossed;
}

void for_crossings(const Body& body, const Cut& cut, std::span<const Segment> segments,
                   const std::function<void(std::size_t, const FlatPiece&)>& visit) {
  const SegmentBins bins(body, segments);
  for (const FlatPiece& piece : cut.surface.pieces)
    for_crossed(body, bins, segments, piece, [&](std::size_t n) { visit(n, piece); });
}

void cut_springs(Model& model, RegionIndex& regions, Faults& faults) {
  const std::vector<Cut>& cuts = model.scene->of(Family::lattices).front()->cuts;
  if (cuts.empty()) return;
  if (model.body.is_listed())
    cut_list(model, cuts, regions, faults);
  else
    cut_grid(model, cuts, regions, faults);
}

}  // namespace hyperlattice
