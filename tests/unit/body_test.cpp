// The body: the order of its particles, the counts of particles and springs that the paper gives,
// and faults of lattice components.
#include <model/body.hpp>

#include <support/body.hpp>

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace body_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A lattice of the given runs, for tests of the faults that build_body finds.
struct Runs {
  std::vector<Run> runs;
  static constexpr Neighbour neighbours[] = {{1, 0, 0, 0}, {0, 1, 0, 0}};

  static bool build(const void* self, const LatticeSink& sink, const Complaint& why) noexcept {
    return detail::guarded(why, [&] {
      Grid grid;
      grid.spacing = grid.site_volume = grid.membrane_distance = 1;
      grid.sites = {10, 3, 2};
      grid.neighbours = neighbours;
      sink.grid(grid);
      for (const Run& run : static_cast<const Runs*>(self)->runs)
        sink.run(run.j, run.k, run.begin, run.end);
    });
  }
};
Body body_of(const Runs& runs) { return build_body({Runs::build}, &runs); }

TEST(Body, HollowSphereHasThePapersCounts) {
  const Body body = cubic_body(ball(20e-3, 50e-3), 1e-3);
  EXPECT_EQ(body.particles, 490432u);
  EXPECT_EQ(body.springs[0], 1443924u);
  EXPECT_EQ(body.springs[1], 2865216u);
  EXPECT_EQ(body.base_springs(), 4309140u);
  EXPECT_EQ(body.reach, 1);
}

TEST(Body, CubeHasTheSpringsOfItsClosedForm) {
  for (const int n : {1, 2, 5}) {
    const auto N = static_cast<std::uint64_t>(n);
    const Body body = cubic_body(box({1.0 * n, 1.0 * n, 1.0 * n}), 1);
    EXPECT_EQ(body.particles, N * N * N);
    EXPECT_EQ(body.springs[0], 3 * N * N * (N - 1));
    EXPECT_EQ(body.springs[1], 6 * N * (N - 1) * (N - 1));
  }
}

TEST(Body, ParticlesStandAtHalfIntegersInTheOrderZyx) {
  const Body body = cubic_body(ball(2, 4), 1);
  Vec3 last{-1e9, -1e9, -1e9};
  for (Particle p = 0; p < body.particles; ++p) {
    const Vec3 at = body.position(p);
    for (const double c : {at.x, at.y, at.z}) EXPECT_EQ(std::abs(std::remainder(c, 1.0)), 0.5);
    EXPECT_LT(std::make_tuple(last.z, last.y, last.x), std::make_tuple(at.z, at.y, at.x));
    EXPECT_EQ(body.at(body.site(p)), p);
    last = at;
  }
  EXPECT_EQ(body.at({-1, 0, 0}), Body::no_particle);
  EXPECT_EQ(body.at({3, 3, 3}), Body::no_particle);  // the cavity
  EXPECT_EQ(body.at({0, 0, 99}), Body::no_particle);
}

TEST(Body, ForwardNeighboursAreHalfOfEighteen) {
  const Body body = cubic_body(ball(0, 2), 1);
  std::set<std::tuple<int, int, int>> all;
  for (const Neighbour& n : body.neighbours) {
    EXPECT_EQ(n.dx * n.dx + n.dy * n.dy + n.dz * n.dz, n.spring_class == 0 ? 1 : 2);
    all.insert({n.dx, n.dy, n.dz});
    all.insert({-n.dx, -n.dy, -n.dz});
  }
  EXPECT_EQ(body.neighbours.size(), 9u);
  EXPECT_EQ(all.size(), 18u);
}

TEST(Body, RefusesALatticeThatBreaksItsPromises) {
  EXPECT_EQ(body_of({{{0, 0, 0, 3, 0}, {0, 0, 5, 10, 0}, {2, 1, 0, 10, 0}}}).particles, 18u);
  EXPECT_THROW(body_of({}), std::invalid_argument);
  EXPECT_THROW(body_of({{{0, 0, 0, 11, 0}}}), std::invalid_argument);
  EXPECT_THROW(body_of({{{3, 0, 0, 5, 0}}}), std::invalid_argument);
  EXPECT_THROW(body_of({{{0, 1, 0, 5, 0}, {0, 0, 0, 5, 0}}}), std::invalid_argument);
  EXPECT_THROW(body_of({{{0, 0, 4, 6, 0}, {0, 0, 5, 8, 0}}}), std::invalid_argument);
}

TEST(Body, CubicRefusesShapesThatItCannotFill) {
  EXPECT_THROW(cubic_body(solid({0, 0, 0}, {1, 1, 1}, [](Vec3) { return false; }), 0.1),
               std::invalid_argument);
  EXPECT_THROW(cubic_body(solid({0, 0, 0}, {1, 1, infinity}, [](Vec3) { return true; }), 0.1),
               std::invalid_argument);
  EXPECT_THROW(cubic_body(solid({0, 0, 0}, {1, 1, 1}, [](Vec3) { return true; }), 1e-12),
               std::invalid_argument);
  EXPECT_THROW(cubic_body(solid({0, 0, 0}, {1, 1, 1}, [](Vec3) { return true; }), 1e-4),
               std::invalid_argument);
}

}  // namespace body_test
