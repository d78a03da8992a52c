// Parts of loads that answer: forces along springs, and areas that follow a surface.
//
//   void declare(const LoadBody& body, const LoadSink& sink) {
//     push_.declare(body, sink, region, ...);
//   }
//   Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
//     return push_.force(motion, n);
//   }
#pragma once

#include <hyperlattice/load.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <vector>

namespace hyperlattice {

/// Equal and opposite forces on the ends of each base spring of a region, along the present line
/// between them in space. They conserve momentum and angular momentum to round-off. A spring
/// belongs to the region if both of its ends do.
class SpringPush {
 public:
  /// Watches the ends of the springs. `strength(spring)` returns the force, N, that pushes the ends
  /// apart at load factor 1. Throws std::invalid_argument if the region has breakable springs or no
  /// springs.
  template <class Strength>
  void declare(const LoadBody& body, const LoadSink& sink, RegionId region,
               const Strength& strength) {
    const std::span<const Particle> particles = body.particles(region);
    std::map<Particle, std::vector<Link>> links;
    const auto number = [&](Particle particle) {
      const auto found = std::lower_bound(particles.begin(), particles.end(), particle);
      return found == particles.end() || *found != particle
                 ? particles.size()
                 : static_cast<std::size_t>(found - particles.begin());
    };
    for (const RestSpring& spring : body.springs(region)) {
      const std::size_t a = number(spring.a), b = number(spring.b);
      if (a == particles.size() || b == particles.size()) continue;
      if (spring.breakable)
        throw std::invalid_argument(
            "a region whose springs do not break: the load would go on pushing along those that "
            "are gone");
      const Vec3 rest = body.position(spring.b) - body.position(spring.a);
      const double push = strength(spring);
      links[spring.a].push_back({b, rest, push});
      links[spring.b].push_back({a, -rest, push});
    }
    if (!particles.empty() && links.empty())
      throw std::invalid_argument(
          "a region with springs: no spring has both of its ends in this one");
    for (const Particle particle : particles) {
      sink.watch(particle);
      first_.push_back(links_.size());
      const std::vector<Link>& own = links[particle];
      links_.insert(links_.end(), own.begin(), own.end());
    }
    first_.push_back(links_.size());
  }

  Vec3 force(const WatchedMotion& motion, std::size_t n) const {
    Vec3 sum;
    if (motion.factor == 0) return sum;
    for (std::size_t l = first_[n]; l < first_[n + 1]; ++l) {
      const Link& link = links_[l];
      const Vec3 apart = link.rest + (motion.displacement[link.other] - motion.displacement[n]);
      sum -= (motion.factor * link.push / norm(apart)) * apart;
    }
    return sum;
  }

 private:
  struct Link {
    std::size_t other = 0;  ///< number of the watched particle
    Vec3 rest;              ///< vector at rest to the other end, m
    double push = 0;        ///< N
  };
  std::vector<Link> links_;
  std::vector<std::size_t> first_;  ///< first link of each watched particle; one more at the end
};

/// The open areas of a region, which turn and stretch with the body around each particle: cof(F) A,
/// where the deformation gradient F is the least-squares fit to the particle's springs. The first
/// count() watched particles are those that have an area.
class MovingAreas {
 public:
  void declare(const LoadBody& body, const LoadSink& sink, RegionId region, const auto& reaction) {
    const std::span<const OpenArea> surface = body.open_areas(region);
    if (surface.empty())
      throw std::invalid_argument(
          "the region has no open face: expected a surface, such as inner_surface");
    areas_.assign(surface.begin(), surface.end());
    std::map<Particle, std::size_t> numbers;
    for (const OpenArea& open : areas_) {
      sink.watch(open.particle, reaction(open));
      numbers.emplace(open.particle, numbers.size());
    }
    std::vector<std::vector<Arm>> arms(areas_.size());
    const auto add = [&](Particle here, Particle there) {
      const auto found = numbers.find(here);
      if (found == numbers.end() || found->second >= areas_.size()) return;
      const auto [other, fresh] = numbers.try_emplace(there, numbers.size());
      if (fresh) sink.look_at(there);
      arms[found->second].push_back({other->second, body.position(there) - body.position(here)});
    };
    for (const RestSpring& spring : body.springs(region)) {
      add(spring.a, spring.b);
      add(spring.b, spring.a);
    }
    for (std::vector<Arm>& around : arms) {
      first_.push_back(arms_.size());
      weigh(around);
      arms_.insert(arms_.end(), around.begin(), around.end());
    }
    first_.push_back(arms_.size());
  }

  std::size_t count() const { return areas_.size(); }
  /// Returns the outward area vector, m2, of watched particle n < count().
  Vec3 area(const WatchedMotion& motion, std::size_t n) const {
    std::array<Vec3, 3> F = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  // columns of F
    for (std::size_t a = first_[n]; a < first_[n + 1]; ++a) {
      const Vec3 moved = motion.displacement[arms_[a].other] - motion.displacement[n],
                 w = arms_[a].weight;
      F[0] += w.x * moved;
      F[1] += w.y * moved;
      F[2] += w.z * moved;
    }
    const Vec3 rest = areas_[n].area;
    return rest.x * cross(F[1], F[2]) + rest.y * cross(F[2], F[0]) + rest.z * cross(F[0], F[1]);
  }

 private:
  struct Arm {
    std::size_t other = 0;  ///< number of the watched particle
    Vec3 weight;  ///< in declare() first the arm itself, m; then (sum of arm arm^T)^-1 arm, 1/m
  };

  static void weigh(std::vector<Arm>& arms) {
    Vec3 x, y, z;  // rows of the sum
    double size = 0;
    for (const Arm& arm : arms) {
      const Vec3 r = arm.weight;
      x += r.x * r;
      y += r.y * r;
      z += r.z * r;
      size += dot(r, r);
    }
    const double determinant = dot(x, cross(y, z));
    if (!(determinant > 1e-6 * size * size * size / 27))
      throw std::invalid_argument(
          "a surface of a body at least two particles thick: the springs of one of its particles "
          "lie in a plane");
    const Vec3 u = cross(y, z), v = cross(z, x),
               w = cross(x, y);  // columns of the adjugate of the symmetric sum
    for (Arm& arm : arms)
      arm.weight =
          (1 / determinant) * Vec3{dot(u, arm.weight), dot(v, arm.weight), dot(w, arm.weight)};
  }

  std::vector<OpenArea> areas_;
  std::vector<Arm> arms_;
  std::vector<std::size_t> first_;  ///< first arm of each area; one more at the end
};

/// An actuator inside a body: forces along its springs, changed rest lengths, or the pressure of a
/// chamber. Exactly one of the three is set; values hold at load factor 1.
struct Actuator {
  /// Force of each whole base spring, N; positive pushes its ends apart.
  std::optional<double> force;
  /// Change of rest length over rest length; pushes the ends apart with k L0 strain, exact for a
  /// linear spring.
  std::optional<double> strain;
  std::optional<double> pressure;  ///< pressure, Pa, on the turned and stretched faces

  void declare(const LoadBody& body, const LoadSink& sink, RegionId region) {
    if (pressure)
      return areas.declare(body, sink, region,
                           [](const OpenArea&) { return LoadStiffnessBound{}; });
    push.declare(body, sink, region, [&](const RestSpring& spring) {
      return force ? *force * spring.share : spring.stiffness * spring.rest_length * *strain;
    });
  }
  Vec3 answer(const WatchedMotion& motion, std::size_t n) const {
    if (!pressure) return push.force(motion, n);
    return motion.factor == 0 || n >= areas.count()
               ? Vec3{}
               : (-motion.factor * *pressure) * areas.area(motion, n);
  }

  SpringPush push;
  MovingAreas areas;
};

}  // namespace hyperlattice
