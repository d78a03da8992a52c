// The tetrahedra of bodies and of periodic samples.
#include <geometry/delaunay.hpp>
#include <model/nodal_volumes.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hyperlattice {
namespace {

std::array<Vec3, 3> edges_of(const Corners& corners, std::span<const Vec3> at) {
  const Vec3 first = at[corners[0]];
  return {at[corners[1]] - first, at[corners[2]] - first, at[corners[3]] - first};
}

double longest_edge(const std::array<Vec3, 3>& edges) {
  return std::max({norm(edges[0]), norm(edges[1]), norm(edges[2]), norm(edges[1] - edges[0]),
                   norm(edges[2] - edges[0]), norm(edges[2] - edges[1])});
}

/// Returns the triangulation without tetrahedra outside of the body.
std::vector<Corners> inside(const std::vector<Tetrahedron>& all, std::span<const Vec3> at,
                            double longest) {
  constexpr double flat = 0.004;
  std::vector<std::uint8_t> is_flat(all.size()), is_outside(all.size());
  std::vector<std::uint32_t> outside;
  const auto leave_out = [&](std::uint32_t tetrahedron) {
    is_outside[tetrahedron] = 1;
    outside.push_back(tetrahedron);
  };
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    const std::array<Vec3, 3> edges = edges_of(all[t].corners, at);
    const double length = longest_edge(edges);
    is_flat[t] = volume_of(edges) < flat * length * length * length ? 1 : 0;
    const auto& neighbours = all[t].neighbours;
    const bool at_hull =
        std::find(neighbours.begin(), neighbours.end(), no_tetrahedron) != neighbours.end();
    if (length > longest || (at_hull && is_flat[t] != 0)) leave_out(t);
  }
  for (std::size_t n = 0; n < outside.size(); ++n)
    for (const std::uint32_t next : all[outside[n]].neighbours)
      if (next != no_tetrahedron && is_flat[next] != 0 && is_outside[next] == 0) leave_out(next);
  std::vector<Corners> found;
  found.reserve(all.size() - outside.size());
  for (std::uint32_t t = 0; t < all.size(); ++t)
    if (is_outside[t] == 0) found.push_back(all[t].corners);
  return found;
}

/// Returns the places of the particles of a sample in a periodic cube, m, from the rest vectors of
/// its springs.
std::vector<Vec3> places_in_sample(const Listed& listed, double edge) {
  struct Step {
    std::uint32_t to;
    Vec3 rest;
  };
  std::vector<std::vector<Step>> steps(listed.sample_particles);
  for (const SampleSpring& spring : listed.sample) {
    steps[spring.a].push_back({spring.b, spring.rest});
    steps[spring.b].push_back({spring.a, -spring.rest});
  }
  const auto wrapped = [edge](Vec3 x) {
    for (std::size_t c = 0; c < 3; ++c) x[c] -= edge * std::floor(x[c] / edge);
    return x;
  };
  const auto is_period = [edge](Vec3 x) {
    constexpr double rounding = 1e-6;
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(x[c] / edge - std::round(x[c] / edge)) > rounding) return false;
    return true;
  };
  std::vector<Vec3> places(listed.sample_particles);
  std::vector<bool> known(places.size());
  std::vector<std::uint32_t> reached{0};
  known[0] = true;
  for (std::size_t n = 0; n < reached.size(); ++n)
    for (const Step& step : steps[reached[n]]) {
      const Vec3 place = places[reached[n]] + step.rest;
      if (!known[step.to]) {
        known[step.to] = true;
        places[step.to] = wrapped(place);
        reached.push_back(step.to);
      } else if (!is_period(place - places[step.to])) {
        throw std::invalid_argument("the sample is not a periodic cube");
      }
    }
  if (reached.size() < places.size())
    throw std::invalid_argument("the sample has parts that no spring joins");
  return places;
}

/// The points of a periodic cube and the copies of those near its faces.
struct PeriodicPoints {
  std::vector<Vec3> at;
  std::vector<std::uint32_t> particle;
  std::vector<std::array<std::int8_t, 3>> period;  ///< of each point, in edges of the cube
};

PeriodicPoints with_copies(std::span<const Vec3> places, double edge, double margin) {
  PeriodicPoints points;
  for (std::int8_t k = -1; k <= 1; ++k)
    for (std::int8_t j = -1; j <= 1; ++j)
      for (std::int8_t i = -1; i <= 1; ++i)
        for (std::uint32_t p = 0; p < places.size(); ++p) {
          const Vec3 x = places[p] + edge * Vec3{double{1} * i, double{1} * j, double{1} * k};
          const bool is_near =
              std::min({x.x, x.y, x.z}) >= -margin && std::max({x.x, x.y, x.z}) <= edge + margin;
          if (!is_near) continue;
          points.at.push_back(x);
          points.particle.push_back(p);
          points.period.push_back({i, j, k});
        }
  return points;
}

}  // namespace

std::array<Vec3, 4> volume_gradients(const std::array<Vec3, 3>& edges) {
  const Vec3 b = (1.0 / 6) * cross(edges[1], edges[2]), c = (1.0 / 6) * cross(edges[2], edges[0]),
             d = (1.0 / 6) * cross(edges[0], edges[1]);
  return {-(b + c + d), b, c, d};
}

void add_derivative(std::vector<VolumeDerivative>& derivatives, std::uint32_t particle,
                    Vec3 gradient) {
  auto same = std::find_if(derivatives.begin(), derivatives.end(),
                           [&](const VolumeDerivative& of) { return of.particle == particle; });
  if (same == derivatives.end()) same = derivatives.insert(same, {particle, {}});
  same->gradient += gradient;
}

Tetrahedra::Tetrahedra(std::size_t points, std::vector<Corners> corners)
    : corners_(std::move(corners)), first_(points + 1, 0) {
  std::sort(corners_.begin(), corners_.end(), [](const Corners& a, const Corners& b) {
    const std::uint32_t least_a = *std::min_element(a.begin(), a.end()),
                        least_b = *std::min_element(b.begin(), b.end());
    return least_a != least_b ? least_a < least_b : a < b;
  });
  for (const Corners& of : corners_)
    for (const std::uint32_t corner : of) ++first_[corner + std::size_t{1}];
  for (std::size_t n = 0; n < points; ++n) first_[n + 1] += first_[n];
  uses_.resize(4 * corners_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < corners_.size(); ++t)
    for (std::uint32_t n = 0; n < 4; ++n) uses_[next[corners_[t][n]]++] = {t & 0x3fffffffU, n & 3U};
}

double Tetrahedra::bytes() const {
  return static_cast<double>(corners_.size() * sizeof(Corners) + uses_.size() * sizeof(Use) +
                             first_.size() * sizeof(std::uint32_t));
}

Tetrahedra tetrahedra_of(const Listed& listed) {
  constexpr double longest = 2.5;  // over the mean length of the springs
  double length = 0;
  for (const ListedSpring& spring : listed.springs)
    length += norm(listed.positions[spring.b] - listed.positions[spring.a]);
  length /= static_cast<double>(std::max<std::size_t>(1, listed.springs.size()));
  return {listed.positions.size(),
          inside(delaunay(listed.positions), listed.positions, longest * length)};
}

SampleVolumes volumes_of_sample(const Listed& listed) {
  const double edge = std::cbrt(listed.sample_volume);
  const std::vector<Vec3> places = places_in_sample(listed, edge);
  // Wide enough for the spheres of all tetrahedra with a corner in the cube.
  constexpr double neighbours = 4;
  const double margin =
      std::min(0.75, neighbours / std::cbrt(static_cast<double>(places.size()))) * edge;
  const PeriodicPoints points = with_copies(places, edge, margin);
  SampleVolumes found;
  found.volumes.resize(places.size());
  found.derivatives.resize(places.size());
  double volume = 0;
  for (const Tetrahedron& tetrahedron : delaunay(points.at)) {
    // Each tetrahedron has copies; the one whose lowest particle is in the cube stands for all.
    const auto lowest = *std::min_element(
        tetrahedron.corners.begin(), tetrahedron.corners.end(),
        [&](std::uint32_t a, std::uint32_t b) { return points.particle[a] < points.particle[b]; });
    if (points.period[lowest] != std::array<std::int8_t, 3>{}) continue;
    const std::array<Vec3, 3> edges = edges_of(tetrahedron.corners, points.at);
    const std::array<Vec3, 4> gradients = volume_gradients(edges);
    volume += volume_of(edges);
    for (const std::uint32_t corner : tetrahedron.corners) {
      const std::uint32_t particle = points.particle[corner];
      found.volumes[particle] += volume_of(edges) / 4;
      for (std::size_t n = 0; n < 4; ++n) {
        const std::uint32_t other = points.particle[tetrahedron.corners[n]];
        add_derivative(found.derivatives[particle], other, 0.25 * gradients[n]);
      }
    }
  }
  constexpr double rounding = 1e-6;
  if (!(std::abs(volume - listed.sample_volume) < rounding * listed.sample_volume))
    throw std::invalid_argument("the tetrahedra of the sample do not fill it");
  return found;
}

}  // namespace hyperlattice
