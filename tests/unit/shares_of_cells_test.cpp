// Bodies of partial cells: shares of particles and springs, weights, open areas, and regions at a
// surface that cuts cells.
#include <model/surfaces.hpp>
#include <state/weights.hpp>

#include <support/body.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace shares_of_cells_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A lattice of unit cells with given shares, nx by ny by nz, x fastest; 0: no cell.
struct Shares {
  std::array<std::int32_t, 3> count;
  std::vector<double> share;

  double at(Site c) const {
    if (c.i < 0 || c.j < 0 || c.k < 0 || c.i >= count[0] || c.j >= count[1] || c.k >= count[2])
      return 0;
    return share[static_cast<std::size_t>((c.k * count[1] + c.j) * count[0] + c.i)];
  }
  Body body() const {
    static constexpr Neighbour neighbours[] = {{1, 0, 0, 0}, {-1, 1, 0, 1}, {0, 1, 0, 0},
                                               {1, 1, 0, 1}, {0, -1, 1, 1}, {-1, 0, 1, 1},
                                               {0, 0, 1, 0}, {1, 0, 1, 1},  {0, 1, 1, 1}};
    const LatticeFunctions functions{
        [](const void* self, const LatticeSink& sink, const Complaint&) noexcept {
          const auto& shares = *static_cast<const Shares*>(self);
          Grid grid;
          grid.spacing = grid.membrane_distance = grid.site_volume = 1;
          grid.neighbours = neighbours;
          grid.spring_classes = 2;
          grid.boundary = Boundary::partial_cells;
          for (std::size_t axis = 0; axis < 3; ++axis) grid.sites[axis] = shares.count[axis] + 1;
          sink.grid(grid);
          for (std::int32_t k = 0; k < shares.count[2]; ++k)
            for (std::int32_t j = 0; j < shares.count[1]; ++j)
              for (std::int32_t i = 0; i < shares.count[0]; ++i)
                if (const double share = shares.at({i, j, k}); share > 0)
                  sink.partial_run(j, k, i, std::span(&share, 1));
          return true;
        }};
    return build_body(functions, this);
  }
};

Shares random_shares() {
  Shares all{{11, 6, 5}, {}};
  std::mt19937_64 random(3);
  for (int n = 0; n < 11 * 6 * 5; ++n) {
    const double value = static_cast<double>(random() >> 11) * 0x1p-53;
    // Some cells are missing, some are whole.
    all.share.push_back(value < 0.1 ? 0 : value > 0.6 ? 1 : std::round(0x1p20 * value) * 0x1p-20);
  }
  return all;
}

TEST(PartialCells, SharesAreTheMeansOfTheCells) {
  const Shares shares = random_shares();
  const Body body = shares.body();
  double volume = 0, particles = 0;
  for (const double share : shares.share) volume += share;
  EXPECT_EQ(body.cells.volume(), volume);
  EXPECT_TRUE(body.cells.has_partial());
  EXPECT_EQ(body.cells.share_of_cell(Site{-1, 0, 0}), 0);
  for (Particle p = 0; p < body.particles; ++p) {
    const Site s = body.site(p);
    double eight = 0;
    for (int n = 0; n < 8; ++n)
      eight += shares.at({s.i - (n & 1), s.j - (n >> 1 & 1), s.k - (n >> 2)});
    ASSERT_EQ(body.share(p), eight / 8);
    ASSERT_EQ(body.share(s, {1, 1, 0, 1}), (shares.at(s) + shares.at({s.i, s.j, s.k - 1})) / 2);
    particles += body.share(p);
  }
  EXPECT_EQ(particles, volume);
}

TEST(PartialCells, WeightsAreTheShares) {
  const Body body = random_shares().body();
  WeightSets sets;
  std::vector<std::uint32_t> places;
  for (std::int32_t k = 0; k < body.grid.sites[2]; ++k)
    for (std::int32_t j = 0; j < body.grid.sites[1]; ++j) {
      if (body.row(j, k).empty()) continue;
      Row row;
      row.begin = body.row(j, k).front().begin;
      row.end = body.row(j, k).back().end;
      places.clear();
      sets.add_row(body, j, k, row, static_cast<std::uint64_t>((row.end - row.begin + 7) / 8),
                   places);
      for (std::int32_t i = row.begin; i < row.end; ++i) {
        const auto t = static_cast<std::size_t>(i - row.begin);
        const double* set = sets.values() + places[t / lanes];
        if (body.at({i, j, k}) != Body::no_particle) {
          ASSERT_EQ(set[t % lanes], body.share({i, j, k}));
        }
        for (std::size_t n = 0; n < body.neighbours.size(); ++n)
          ASSERT_EQ(set[(n + 1) * lanes + t % lanes], body.share({i, j, k}, body.neighbours[n]));
      }
    }
}

// Under a homogeneous strain the springs pull each particle with the stress times its open area,
// whatever the shares are.
TEST(PartialCells, PassThePatchTestWithRandomShares) {
  const Body body = random_shares().body();
  const Surfaces surfaces(body);
  std::vector<Vec3> area(body.particles);
  for (const OpenArea& open : open_areas(body, surfaces, *built_in_region("surface")))
    area[open.particle] = open.area;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      double strain[3][3] = {};
      strain[a][b] = strain[b][a] = 1;
      const auto moved = [&](Vec3 r) {
        return Vec3{dot({strain[0][0], strain[0][1], strain[0][2]}, r),
                    dot({strain[1][0], strain[1][1], strain[1][2]}, r),
                    dot({strain[2][0], strain[2][1], strain[2][2]}, r)};
      };
      std::vector<Vec3> force(body.particles);
      for (Particle p = 0; p < body.particles; ++p)
        for (const Neighbour& to : body.neighbours) {
          const Site s = body.site(p);
          const double share = body.share(s, to);
          if (share == 0) continue;
          const Vec3 r{1.0 * to.dx, 1.0 * to.dy, 1.0 * to.dz};
          const Vec3 pull = share * dot(moved(r), r) / dot(r, r) * r;
          force[p] += pull;
          force[body.at({s.i + to.dx, s.j + to.dy, s.k + to.dz})] -= pull;
        }
      // Springs of stiffness 1 and length 1: C11 = 3, C12 = C44 = 1.
      const auto traction = [&](Vec3 n) {
        const double trace = strain[0][0] + strain[1][1] + strain[2][2];
        return trace * n + 2 * moved(n);
      };
      double worst = 0;
      for (Particle p = 0; p < body.particles; ++p)
        worst = std::max(worst, norm(force[p] + traction(area[p])));
      EXPECT_LT(worst, 1e-13) << a << b;
    }
}

/// A box with planes that cut cells: from 0.4 to 6.7, 0 to 4, 0.5 to 3.5.
Shares cut_box() {
  Shares all{{7, 4, 4}, {}};
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 7; ++i)
        all.share.push_back((i == 0 ? 0.625 : i == 6 ? 0.75 : 1) * (k == 0 || k == 3 ? 0.5 : 1));
  return all;
}

TEST(PartialCells, EndsOfABodyHoldTheCornersOfTheCellsThatTheyCut) {
  const Body body = cut_box().body();
  const Surfaces surfaces(body);
  const auto count = [&](const char* side) {
    return particles_in(body, surfaces, *built_in_region(side)).size();
  };
  EXPECT_EQ(count("x_min"), 2u * 5 * 5);
  EXPECT_EQ(count("x_max"), 2u * 5 * 5);
  EXPECT_EQ(count("y_min"), 8u * 5);  // this face is one of the cells
  EXPECT_EQ(count("z_min"), 2u * 8 * 5);
  const auto area = [&](const char* side) {
    Vec3 sum;
    for (const OpenArea& open : open_areas(body, surfaces, *built_in_region(side)))
      sum += open.area;
    return sum;
  };
  EXPECT_EQ(area("x_min"), (Vec3{-4 * 3, 0, 0}));
  EXPECT_EQ(area("x_max"), (Vec3{4 * 3, 0, 0}));
  EXPECT_EQ(area("y_max"), (Vec3{0, 6.375 * 3, 0}));
  EXPECT_EQ(area("z_min"), (Vec3{0, 0, -4 * 6.375}));
  EXPECT_EQ(area("surface"), Vec3{});
}

TEST(PartialCells, AnEndOfWholeCellsIsOneLayer) {
  // A round bar along x, cut by its round side only.
  Shares all{{3, 3, 3}, {}};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) all.share.push_back(j == 1 && k == 1 ? 1 : 0.25 + 0.125 * i);
  const Body body = all.body();
  const Surfaces surfaces(body);
  EXPECT_EQ(particles_in(body, surfaces, *built_in_region("x_min")).size(), 16u);
}

TEST(PartialCells, ACavityHasItsOwnFaces) {
  // A wall of three cells around one empty cell; the cells beside it and the outermost are partial.
  Shares all{{7, 7, 7}, {}};
  for (int k = -3; k <= 3; ++k)
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i) {
        const int far = std::max({std::abs(i), std::abs(j), std::abs(k)});
        all.share.push_back(far == 0 ? 0 : far == 1 ? 0.25 : far == 2 ? 1 : 0.5);
      }
  const Body body = all.body();
  const Surfaces surfaces(body);
  for (const Particle p : particles_in(body, surfaces, *built_in_region("inner_surface")))
    for (const double x : {body.position(p).x, body.position(p).y, body.position(p).z}) {
      ASSERT_GE(x, 2);
      ASSERT_LE(x, 5);
    }
  double inner = 0, outer = 0;  // areas
  for (const auto& [name, sum] : {std::pair{"inner_surface", &inner}, {"outer_surface", &outer}})
    for (const OpenArea& open : open_areas(body, surfaces, *built_in_region(name)))
      *sum += dot(open.area, body.position(open.particle) - Vec3{3.5, 3.5, 3.5});
  // By the divergence theorem these are minus and plus three volumes: of the empty space inside,
  // and of all within the outer surface.
  EXPECT_NEAR(inner, -3 * (1 + 26 * 0.75), 1e-12);
  EXPECT_NEAR(outer, 3 * (125 + 218 * 0.5), 1e-12);
}

}  // namespace shares_of_cells_test
