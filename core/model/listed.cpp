#include <model/listed.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hyperlattice {

namespace {

constexpr std::size_t most_particles = 4294967294;

void check_sizes(const PointList& points) {
  if (!(points.spacing > 0 && points.site_volume > 0 && points.membrane_distance > 0) ||
      !std::isfinite(points.spacing))
    throw std::invalid_argument("the list's spacing or volume is not positive");
  if (points.positions.empty()) throw std::invalid_argument("the lattice has no particles");
  if (points.positions.size() > most_particles)
    throw std::invalid_argument("a list holds at most 4294967294 particles");
  if (!points.volumes.empty() && points.volumes.size() != points.positions.size())
    throw std::invalid_argument("the list has not one volume for each particle");
  for (std::size_t n = 0; n < points.positions.size(); ++n) {
    const Vec3 x = points.positions[n];
    if (!std::isfinite(x.x + x.y + x.z))
      throw std::invalid_argument("particle " + std::to_string(n) +
                                  " has a place that is not finite");
    if (!points.volumes.empty() && !(points.volumes[n] > 0 && std::isfinite(points.volumes[n])))
      throw std::invalid_argument("particle " + std::to_string(n) +
                                  " has a volume that is not positive");
  }
}

std::string pair_text(std::uint64_t a, std::uint64_t b) {
  return "the spring between particles " + std::to_string(a) + " and " + std::to_string(b);
}

void check_spring(const ListedSpring& spring, Vec3 rest, std::size_t particles) {
  const std::string which = pair_text(spring.a, spring.b);
  if (spring.a >= particles || spring.b >= particles)
    throw std::invalid_argument(which + ": there are " + std::to_string(particles) + " particles");
  if (spring.a == spring.b) throw std::invalid_argument(which + " joins a particle to itself");
  if (!(norm(rest) > 0)) throw std::invalid_argument(which + " has no length");
  if (!std::isfinite(spring.stiffness) || spring.stiffness == 0)
    throw std::invalid_argument(which + " has no stiffness");
}

/// Returns the particles sorted by slabs and strips.
std::vector<std::uint64_t> along_strips(const PointList& points) {
  struct Key {
    double slab, strip, x;
    std::uint64_t source;
  };
  Vec3 low = points.positions.front();
  for (const Vec3 x : points.positions)
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
  std::vector<Key> keys;
  keys.reserve(points.positions.size());
  for (std::size_t n = 0; n < points.positions.size(); ++n) {
    const Vec3 x = (1 / points.spacing) * (points.positions[n] - low);
    constexpr double rounding = 1e-6;  // keeps particles in planes of the spacing together
    keys.push_back({std::floor(x.z + rounding), std::floor(x.y + rounding), x.x, n});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.slab != b.slab     ? a.slab < b.slab
           : a.strip != b.strip ? a.strip < b.strip
           : a.x != b.x         ? a.x < b.x
                                : a.source < b.source;
  });
  std::vector<std::uint64_t> order;
  order.reserve(keys.size());
  for (const Key& key : keys) order.push_back(key.source);
  return order;
}

/// Sorts each stretch of the order by number of springs, descending.
void sort_stretches(std::vector<std::uint64_t>& order, const PointList& points) {
  std::vector<std::uint32_t> springs(order.size(), 0);
  for (const ListedSpring& spring : points.springs)
    for (const std::uint32_t end : {spring.a, spring.b})
      if (end < springs.size()) ++springs[end];
  for (auto first = order.begin(); first != order.end();) {
    const auto last = first + std::min<std::ptrdiff_t>(Listed::stretch, order.end() - first);
    std::stable_sort(first, last,
                     [&](std::uint64_t a, std::uint64_t b) { return springs[a] > springs[b]; });
    first = last;
  }
}

}  // namespace

Listed sorted(const PointList& points) {
  check_sizes(points);
  Listed listed;
  listed.source = along_strips(points);
  sort_stretches(listed.source, points);
  std::vector<std::uint32_t> place(listed.source.size());
  for (std::size_t n = 0; n < listed.source.size(); ++n) {
    place[listed.source[n]] = static_cast<std::uint32_t>(n);
    listed.positions.push_back(points.positions[listed.source[n]]);
    if (!points.volumes.empty())
      listed.shares.push_back(points.volumes[listed.source[n]] / points.site_volume);
  }
  listed.springs.reserve(points.springs.size());
  for (const ListedSpring& spring : points.springs) {
    const bool known = spring.a < place.size() && spring.b < place.size();
    check_spring(spring, known ? points.positions[spring.b] - points.positions[spring.a] : Vec3{},
                 place.size());
    const std::uint32_t a = place[spring.a], b = place[spring.b];
    listed.springs.push_back({std::min(a, b), std::max(a, b), spring.stiffness});
  }
  const auto before = [](const ListedSpring& s, const ListedSpring& t) {
    return s.a != t.a ? s.a < t.a : s.b < t.b;
  };
  std::sort(listed.springs.begin(), listed.springs.end(), before);
  const auto same = [](const ListedSpring& s, const ListedSpring& t) {
    return s.a == t.a && s.b == t.b;
  };
  if (const auto twice = std::adjacent_find(listed.springs.begin(), listed.springs.end(), same);
      twice != listed.springs.end())
    throw std::invalid_argument(pair_text(listed.source[twice->a], listed.source[twice->b]) +
                                " is given twice");
  return listed;
}

void keep_sample(Listed& listed, const PeriodicSample& sample) {
  if (sample.particles == 0 || !(sample.volume > 0))
    throw std::invalid_argument("the lattice's sample has no particles or no volume");
  for (const SampleSpring& spring : sample.springs)
    if (spring.a >= sample.particles || spring.b >= sample.particles || !(norm(spring.rest) > 0) ||
        !std::isfinite(norm(spring.rest)))
      throw std::invalid_argument("the lattice's sample has a spring without length, or to nobody");
  listed.sample_particles = sample.particles;
  listed.sample_volume = sample.volume;
  listed.sample.assign(sample.springs.begin(), sample.springs.end());
}

}  // namespace hyperlattice
