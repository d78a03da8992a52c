// A body of cells of several materials is the sum of its cells. Borders between materials are where
// the scene puts them, at every spacing.
#include <model/build.hpp>

#include <support/cells.hpp>
#include <support/energy_balance.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

namespace cell_materials_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double poisson = 0.25, soft = 2e8, contrast = 1e5;

/// Stress over strain of a bar with held sides.
double confined(double young) {
  return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
}

/// A bar of two materials, the second beyond a corner, with held sides and a load.
AtRest two_part_bar(double spacing, Vec3 size, const Keys& membrane, Vec3 border,
                    const Stages& load) {
  const Keys stiff = {{"name", "stiff"}, {"region", box(border, {1, 1, 1})}};
  return AtRest(SceneBuilder{}
                    .lattice("lattices.cubic", spacing, box({}, size), {{"boundary", "cells"}})
                    .stages(elastic(soft, membrane))
                    .stages(elastic(contrast * soft, membrane + stiff))
                    .load("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
                    .load("loads.fixed", {{"name", "sides"}, {"on", "all"}, {"axes", "yz"}})
                    .stages(load)
                    .stages(to_rest)
                    .text());
}
Stages pressure(double value) {
  return stage("loads.pressure", {{"on", "x_max"}, {"pressure", value}});
}

/// The second of two materials of a body, beyond an oblique plane.
const Keys beyond_plane = {
    {"region", {{"half_space", {{"point", {2.5e-3, 0, 0}}, {"normal", {-1, 0.3, 0.2}}}}}}};

TEST(CellMaterials, ABarOfTwoHalvesInARowIsExact) {
  constexpr double length = 0.16, border = 0.048, width = 0.016, pull = 1e-3;
  for (const double spacing : {4e-3, 2e-3}) {
    const AtRest bar = two_part_bar(spacing, {length, width, width}, {{"poisson", poisson}},
                                    {border, -1, -1}, pressure(-pull));
    const std::int32_t end = bar.model().body.high.i,
                       at_border = static_cast<std::int32_t>(std::lround(border / spacing));
    const double of_soft = pull / confined(soft) * border,
                 of_stiff = pull / confined(contrast * soft) * (length - border);
    EXPECT_NEAR(bar.mean(0, [&](Site s) { return s.i == at_border; }) / of_soft, 1, 1e-6)
        << spacing;
    EXPECT_NEAR(bar.mean(0, [&](Site s) { return s.i == end; }) / (of_soft + of_stiff), 1, 1e-6)
        << spacing;
  }
}

// A particle on a border has one height, while the two materials need two different heights. In a
// free membrane, the border therefore acts as if a part of a cell were stiffer.
TEST(CellMaterials, AFreeMembraneErrsAtABorderByATenthOfACell) {
  constexpr double nu = 0.1, modulus = soft * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), border = 0.048,
                   width = 0.008, pull = 1e-3;
  for (const double spacing : {4e-3, 2e-3}) {
    const AtRest bar =
        two_part_bar(spacing, {0.16, width, width}, {{"membrane", "I-m"}, {"poisson", nu}},
                     {border, -1, -1}, pressure(-pull));
    const std::int32_t end = bar.model().body.high.i;
    const double exact = pull / modulus * (border + (0.16 - border) / contrast);
    EXPECT_NEAR((1 - bar.mean(0, [&](Site s) { return s.i == end; }) / exact) * border / spacing,
                0.1091, 1e-3)
        << spacing;
  }
}

TEST(CellMaterials, ABarOfTwoHalvesSideBySideHasTheMeanModulus) {
  constexpr double stretch = 1e-9;
  const AtRest bar = two_part_bar(
      1e-3, {8e-3, 4e-3, 6e-3}, {{"poisson", poisson}}, {-1, 1e-3, -1},
      stage("loads.displacement",
            {{"on", "x_max"}, {"axes", "x"}, {"value", Vec3{stretch, 0, 0}}, {"rise", 1e-9}}));
  const double force = -bar.simulation->force_on_load().at(2).x,
               mean = (confined(soft) + 3 * confined(contrast * soft)) / 4;
  EXPECT_NEAR(force / (mean * 24e-6 * stretch / 8e-3), 1, 1e-6);
}

/// Two materials of different density with an oblique border.
std::string two(const Keys& first = {}, const Keys& second = {}, const Stages& stages = {}) {
  const Keys other = {{"young", 4e10}, {"density", 7000}, {"membrane", "I-m"}, {"poisson", 0.1}};
  return scene_of_cells(box_mm(6, 5, 4), Keys{{"membrane", "I-m"}, {"poisson", 0.2}} + first,
                        stage("materials.elastic", other + beyond_plane + second) + stages);
}
bool is_second(const CellIndex& cell) {
  return -(cell[0] + 0.5 - 2.5) + 0.3 * (cell[1] + 0.5) + 0.2 * (cell[2] + 0.5) <= 0;
}

TEST(CellMaterials, MassesAndSpringsAreTheMeansOfTheirCells) {
  const auto plan = plan_of(two());
  const Model& model = *plan->model;
  const auto inside = [](const CellIndex& c) {
    return c[0] >= 0 && c[0] < 6 && c[1] >= 0 && c[1] < 5 && c[2] >= 0 && c[2] < 4;
  };
  std::vector<Particle> all(model.body.particles);
  for (Particle p = 0; p < all.size(); ++p) all[p] = p;
  for (const Particle p : all) {
    double mass = 0;
    for_cells_of({}, [&](int di, int dj, int dk) {
      const CellIndex x = corner_of(model, p), cell{x[0] + di, x[1] + dj, x[2] + dk};
      if (inside(cell)) mass += (is_second(cell) ? 7000 : 2500) * 1e-9 / 8;
    });
    EXPECT_NEAR(model.mass(p), mass, 1e-12 * mass) << p;
  }
  for (const RestSpring& spring : springs_at(model, all)) {
    const CellIndex a = corner_of(model, spring.a), b = corner_of(model, spring.b);
    const Neighbour to{b[0] - a[0], b[1] - a[1], b[2] - a[2], 0};
    const int cells = std::abs(to.dx) + std::abs(to.dy) + std::abs(to.dz) == 1 ? 4 : 2;
    double stiffness = 0;
    for_cells_of(to, [&](int di, int dj, int dk) {
      const CellIndex cell{a[0] + di, a[1] + dj, a[2] + dk};
      if (inside(cell))
        stiffness += model.materials[is_second(cell) ? 1 : 0].constants.base_stiffness / cells;
    });
    EXPECT_NEAR(spring.stiffness, stiffness, 1e-12 * stiffness) << spring.a << ' ' << spring.b;
  }
}

TEST(CellMaterials, StaticsAndStepsHaveTheSameSprings) {
  const AtRest body(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(6, 5, 4),
                   {{"boundary", "cells"}, {"anchor", {0, 0, 0}}})
          .stages(elastic(1e10, {{"membrane", "I-m"}, {"poisson", 0.2}}))
          .stages(elastic(4e10, Keys{{"membrane", "I-m"}, {"poisson", 0.1}} + beyond_plane))
          .load("loads.fixed", {{"on", "x_min"}})
          .load("loads.displacement",
                {{"on", "x_max"}, {"axes", "x"}, {"value", {1e-6, 0, 0}}, {"rise", 1e-9}})
          .stages(to_rest)
          .text());
  const auto left = forces(body.model(), body.u, body.heights);
  double most = 0, least = 0;
  for (Particle p = 0; p < body.model().body.particles; ++p) {
    const Site at = body.model().body.site(p);
    const double force = std::max(
        {std::abs(left[p][0]), std::abs(left[p][1]), std::abs(left[p][2]), std::abs(left[p][3])});
    if (at.i > 0 && at.i < 6) least = std::max(least, force);
  }
  // The mean force on a particle of the pulled face sets the scale.
  most = std::abs(body.simulation->force_on_load().at(1).x) / 30;
  EXPECT_LT(least, 1e-5 * most);
}

TEST(CellMaterials, TheWeakestMaterialOfASpringBreaksIt) {
  const auto limit = [](double strain) {
    return Keys{{"failure", {{"type", "failures.strain"}, {"limit", strain}}}};
  };
  for (const bool first_is_weak : {true, false}) {
    const auto plan =
        plan_of(two(limit(first_is_weak ? 1e-3 : 3e-3), limit(first_is_weak ? 3e-3 : 1e-3)));
    const Model& model = *plan->model;
    std::size_t mixed = 0;
    for (Particle p = 0; p < model.body.particles; ++p)
      for (std::uint32_t n = 0; n < model.body.neighbours.size(); ++n) {
        if (!(model.body.share(model.body.site(p), model.body.neighbours[n]) > 0)) continue;
        bool weak = false, strong = false;
        for (const std::uint8_t m : model.materials_of(p, p, n))
          (((m == 0) == first_is_weak) ? weak : strong) = true;
        mixed += weak && strong ? 1 : 0;
        const double strain = model.springs.spring_to(n, model.kinds.of(p), 0).alarm /
                              model.springs.neighbours[n].rest_length;
        EXPECT_NEAR(strain, weak ? 1e-3 : 3e-3, 1e-12) << p << ' ' << n;
      }
    EXPECT_GT(mixed, 50u);
  }
}

TEST(CellMaterials, RegionsHoldCellsByTheirCentres) {
  const auto with_second = [](const Json& region) {
    return plan_of(scene_of_cells(
        box_mm(3, 3, 3), {{"poisson", 0.25}},
        stage("materials.elastic", {{"young", 1e9}, {"density", 1}, {"region", region}})));
  };
  const auto faults = [&](const Json& region) {
    try {
      with_second(region);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(faults(box_of_cells({2, 0, 0}, {3, 3, 3})), "");
  EXPECT_EQ(faults("x_max"), "");
  EXPECT_NE(
      faults({{"sphere", {{"radius", 0.4e-3}}}}).find("holds the centre of none of the body's"),
      std::string::npos);
  const auto plan = with_second("x_max");
  double mass = 0;
  for (Particle p = 0; p < plan->model->body.particles; ++p) mass += plan->model->mass(p);
  EXPECT_NEAR(mass, (18 * 2500 + 9) * 1e-9, 1e-18);
}

/// A spring has the law of its own cells, not that of most cells around its ends.
TEST(CellMaterials, OfTwoLawsDoNotDependOnTheirOrder) {
  const Keys viscous = {{"type", "materials.viscous"}, {"young", 1e10}, {"time", 1e-7}},
             plastic = {{"type", "materials.plastic"},
                        {"young", 2e10},
                        {"yield", 1e6},
                        {"hardening", 0.1}},
             common = {{"density", 2500}, {"membrane", "none"}};
  const auto body = [&](bool is_reversed, const Stages& more) {
    const double far = 1, border = 2e-3;
    const Stages materials =
        is_reversed ? Stages(plastic + common) +
                          Stages(viscous + common +
                                 Keys{{"region", box({-far, -far, -far}, {far, far, border})}})
                    : Stages(viscous + common) +
                          Stages(plastic + common +
                                 Keys{{"region", box({-far, -far, border}, {far, far, far})}});
    return SceneBuilder{}
        .lattice("lattices.cubic", 1e-3, box_mm(3, 3, 4), {{"boundary", "cells"}})
        .stages(materials)
        .stages(more)
        .text();
  };
  const auto moved = [&](bool is_reversed) {
    const auto plan = plan_of(body(is_reversed, stage("solvers.explicit", {{"end_time", 1e-6}})));
    Simulation simulation(*plan->model, 2);
    simulation.set_velocities(noise(3 * plan->model->body.particles, 1), {});
    for (int n = 0; n < 60; ++n) simulation.step(5e-8);
    return displacements(simulation);
  };
  const std::vector<double> one = moved(false), other = moved(true);
  EXPECT_LT(largest(one), 1e-5);  // no more than at the velocities of the start
  EXPECT_LT(distance(one, other), 1e-9 * largest(one));

  const Stages pull =
      stage("loads.fixed", {{"on", "z_min"}}) +
      stage("loads.displacement", {{"on", "z_max"}, {"value", Vec3{0, 0, 1e-5}}, {"rise", 1e-9}}) +
      stage("solvers.static", {{"tolerance", 1e-10}});
  const AtRest first(body(false, pull)), second(body(true, pull));
  EXPECT_LT(distance(first.u, second.u), 1e-7 * largest(first.u));
}

}  // namespace cell_materials_test
