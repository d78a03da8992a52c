// Contact forces between two close particles, by hand; and the search for pairs while particles
// move.
#include "../../plugins/loads/contact/contact.cpp"
#include "../../plugins/loads/contact/pairs.cpp"

#include <gtest/gtest.h>

#include <random>

namespace contact_law_test {

constexpr double spacing = 1e-3, mass = 2e-6, stiffness = 1e6;

/// Particles at these places, with the mass and the stiffness above.
struct Bodies {
  std::vector<Vec3> places;
  std::vector<Particle> all;
  LoadBody body;
  LoadSink sink;

  explicit Bodies(std::vector<Vec3> at) : places(std::move(at)) {
    for (Particle p = 0; p < places.size(); ++p) all.push_back(p);
    body.self = this;
    body.spacing = spacing;
    body.region_particles = [](void* self, RegionId) noexcept {
      return std::span<const Particle>(static_cast<Bodies*>(self)->all);
    };
    body.particle_position = [](void* self, Particle p) noexcept {
      return static_cast<Bodies*>(self)->places[p];
    };
    body.particle_mass = [](void*, Particle) noexcept { return mass; };
    body.region_springs = [](void*, RegionId) noexcept { return std::span<const RestSpring>(); };
    body.particle_gap = [](void*, Particle, Vec3) noexcept { return 0.0; };
    sink.receive_warning = [](void*, std::string_view) noexcept {};
    sink.receive_watched = [](void*, Particle, bool, const LoadStiffnessBound&) noexcept {};
  }
};

/// Forces on all particles.
std::vector<Vec3> forces(const std::vector<Vec3>& places, const std::vector<Vec3>& moved,
                         const std::vector<Vec3>& velocities, double friction = 0,
                         double damping = 0) {
  Bodies bodies(places);
  Contact::Options o;
  o.reach = 0.9;
  o.stiffness = stiffness;
  o.friction = friction;
  o.damping = damping;
  o.grip = 0.2;
  Contact contact(o);
  contact.declare(bodies.body, bodies.sink);
  const WatchedMotion motion{0, 1, moved, velocities, {}};
  contact.prepare(motion);
  std::vector<Vec3> found;
  for (std::size_t n = 0; n < places.size(); ++n) found.push_back(contact.answer(motion, n));
  return found;
}

void expect_near(Vec3 found, Vec3 expected, double tolerance) {
  EXPECT_LT(norm(found - expected), tolerance) << found.x << " " << found.y << " " << found.z;
}

// Two particles, 2 mm apart at rest, are now 0.8 mm apart: the depth of contact is 0.1 mm.
const std::vector<Vec3> two{{0, 0, 0}, {2e-3, 0, 0}}, near{{}, {-1.2e-3, 0, 0}}, still{{}, {}};
constexpr double depth = 1e-4, N = stiffness * depth;

TEST(Contact, PushesApart) {
  const auto f = forces(two, near, still);
  expect_near(f[0], {-N, 0, 0}, 1e-9 * N);
  EXPECT_EQ(f[1], -1.0 * f[0]);  // exactly
  EXPECT_EQ(norm(forces(two, {{}, {-1.0999e-3, 0, 0}}, still)[0]), 0);
}

TEST(Contact, DampingNeverPulls) {
  const double b = 2 * 0.5 * std::sqrt(stiffness * mass / 2);
  expect_near(forces(two, near, {{1, 0, 0}, {}}, 0, 0.5)[1], {N + b, 0, 0}, 1e-9 * N);
  expect_near(forces(two, near, {{-1, 0, 0}, {}}, 0, 0.5)[1], {N - b, 0, 0}, 1e-9 * N);
  EXPECT_EQ(norm(forces(two, near, {{-1e3, 0, 0}, {}}, 0, 0.5)[1]), 0);
}

TEST(Contact, FrictionIsCoulombsAboveAndViscousBelow) {
  const double h = 0.2 * std::sqrt(stiffness * mass / 2), mu = 0.5;
  expect_near(forces(two, near, {{}, {0, 3, 4}}, mu)[1], {N, -h * 3, -h * 4}, 1e-9 * N);
  expect_near(forces(two, near, {{}, {0, 300, 400}}, mu)[1], {N, -mu * N * 0.6, -mu * N * 0.8},
              1e-9 * N);
}

// A spring joins these neighbours. Contact acts only if the spring is compressed by more than a
// tenth.
TEST(Contact, NeighboursAreLeftAlone) {
  const std::vector<Vec3> neighbours{{0, 0, 0}, {0.8e-3, 0, 0}};
  EXPECT_EQ(norm(forces(neighbours, {{}, {-0.079e-3, 0, 0}}, still)[0]), 0);
  expect_near(forces(neighbours, {{}, {-0.09e-3, 0, 0}}, still)[0], {-stiffness * 1e-5, 0, 0},
              1e-9 * N);
}

TEST(Contact, ParticlesThatAreNowhereMeetNobody) {
  for (const double lost : {double{NAN}, double{INFINITY}, 1e300})
    EXPECT_EQ(norm(forces(two, {{}, {lost, 0, 0}}, still)[0]), 0) << lost;
}

TEST(Contact, NoPairIsMissed) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> even(-1, 1);
  constexpr std::size_t count = 300;
  constexpr double reach = 0.35;
  std::vector<Vec3> places(count), moved(count);
  for (Vec3& place : places) place = {even(random), even(random), even(random)};
  contact::Pairs pairs(places, reach);
  std::size_t met = 0;
  for (int step = 0; step < 40; ++step) {
    for (Vec3& way : moved) way = way + 0.02 * Vec3{even(random), even(random), even(random)};
    pairs.find(moved);
    for (std::size_t a = 0; a < count; ++a) {
      const auto of = pairs.of(a);
      EXPECT_TRUE(std::is_sorted(of.begin(), of.end()));
      for (std::uint32_t b = 0; b < count; ++b) {
        if (a == b || norm(pairs.apart(a, b, moved)) >= reach) continue;
        ++met;
        EXPECT_TRUE(std::binary_search(of.begin(), of.end(), b)) << step << ": " << a << ", " << b;
      }
    }
  }
  EXPECT_GT(met, 40 * count);
}

}  // namespace contact_law_test
