// The table of fields: its page, the parts of its names, quantities taken from tensors; and what a
// snapshot of a run gives for each field.
#include <plan/fields.hpp>
#include <run/snapshot.hpp>
#include <support/laws.hpp>
#include <support/rest.hpp>

#include <hyperlattice/fields.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace fields_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

TEST(FieldTable, IsTheTableOfThePage) {
  std::ifstream file(HYPERLATTICE_SOURCE "/docs/guide/outputs.md");
  std::ostringstream text;
  text << file.rdbuf();
  for (const FieldInfo& field : field_table) {
    std::string parts;
    for (const std::string_view part : parts_of(field.kind))
      if (!part.empty()) parts += (parts.empty() ? "`" : " `") + std::string(part) + "`";
    const std::string row = "| `" + std::string(field.name) + "` | " + parts + " | " +
                            std::string(field.unit) + " | " + std::string(field.help) + " | ";
    EXPECT_NE(text.str().find(row), std::string::npos) << row;
  }
}

TEST(FieldTable, FindsFieldsAndTheirParts) {
  EXPECT_EQ(find_field_part("stress").part, "");
  EXPECT_EQ(find_field_part("stress_xy").part, "xy");
  EXPECT_EQ(find_field_part("nominal_stress_yx").field->name, "nominal_stress");
  EXPECT_EQ(find_field_part("principal_direction_1").field->name, "principal_direction_1");
  EXPECT_EQ(find_field_part("principal_stress_3").part, "3");
  for (const char* name : {"stress_yx", "damage_x", "stress_", "broken", "", "_x"})
    EXPECT_EQ(find_field_part(name).field, nullptr) << name;
  EXPECT_EQ(components_of(*find_field("strain")), 6u);
}

TEST(Quantity, TakesNumbersFromTensors) {
  const double t[] = {1, 2, 3, 4, 5, 6};
  double out[max_field_components];
  const Quantity all({"stress", std::nullopt, {}});
  EXPECT_EQ(all.names(), (std::vector<std::string>{"stress_xx", "stress_yy", "stress_zz",
                                                   "stress_yz", "stress_xz", "stress_xy"}));
  all.project(t, {}, out);
  EXPECT_EQ(out[5], 6);
  Quantity({"stress", Projection::yz, {}}).project(t, {}, out);
  EXPECT_EQ(out[0], 4);
  Quantity({"stress", Projection::radial, {}}).project(t, {1, 1, 0}, out);
  EXPECT_NEAR(out[0], (1 + 2 + 2 * 6) / 2.0, 1e-14);
  Quantity({"principal_stress", Projection::second, {}}).project(t, {}, out);
  EXPECT_EQ(out[0], 2);
  const double n[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  Quantity({"nominal_stress", Projection::zx, {}}).project(n, {}, out);
  EXPECT_EQ(out[0], 7);
  Quantity({"nominal_stress", Projection::radial, {}}).project(n, {0, 0, -2}, out);
  EXPECT_EQ(out[0], 9);
}

TEST(Quantity, RefusesAComponentThatTheFieldLacks) {
  std::string said;
  const FaultSink sink{&said, [](void* self, std::string_view, std::string_view what) noexcept {
                         *static_cast<std::string*>(self) = what;
                       }};
  check_quantity_options(QuantityOptions{"stress", Projection::x, {}}, sink);
  EXPECT_EQ(said, "a component of \"stress\": xx, yy, zz, yz, xz, xy, radial");
  said.clear();
  check_quantity_options(QuantityOptions{"stress", Projection::xz, {}}, sink);
  EXPECT_EQ(said, "");
}

std::span<const double> values(const Snapshot& snapshot, std::string_view name) {
  Field field;
  EXPECT_TRUE(snapshot.field(name, field)) << name;
  EXPECT_EQ(field.components, components_of(*find_field(name))) << name;
  return field.values;
}

/// A column of cells that stands under its weight.
TEST(Snapshot, ForcesOfAColumnAtRest) {
  const AtRest column(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(2, 3, 5), {{"boundary", "cells"}})
          .material("materials.elastic", {{"young", 1e8}, {"density", 2500}, {"poisson", 0.25}})
          .load("loads.fixed", {{"on", "z_min"}})
          .load("loads.gravity", {{"acceleration", Vec3{0, 0, -9.81}}})
          .solver("solvers.static", {{"tolerance", 1e-11}})
          .text());
  const Model& model = column.model();
  SnapshotSource source(model, *column.simulation);
  const Snapshot& snapshot = source.take();
  const double weight = 2500 * 30e-9 * 9.81;
  const auto internal = values(snapshot, "internal_force"),
             external = values(snapshot, "external_force"),
             acceleration = values(snapshot, "acceleration");
  double foot = 0, sum = 0;
  for (Particle p = 0; p < model.body.particles; ++p) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(internal[3 * p + c] + external[3 * p + c], 0, 1e-9 * weight);
      EXPECT_LT(std::abs(acceleration[3 * p + c]), 1e-6);
    }
    sum += external[3 * p + 2];
    if (model.body.position(p).z == 0) foot += external[3 * p + 2];
  }
  EXPECT_NEAR(sum, 0, 1e-9 * weight);
  EXPECT_NEAR(foot, 0.9 * weight, 1e-9 * weight);  // half a layer of five stands on the ground
}

/// Before the first step a body at rest without other loads has no acceleration, and a force on a
/// face gives that of its particles.
TEST(Snapshot, HasForcesBeforeTheFirstStep) {
  const auto plan = plan_of(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(2, 2, 2))
          .material("materials.elastic", {{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}})
          .load("loads.fixed", {{"on", "z_min"}})
          .load("loads.gravity", {{"acceleration", Vec3{0, 0, -9.81}}})
          .solver("solvers.explicit", {{"end_time", 1e-5}})
          .text());
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  SnapshotSource source(model, simulation);
  const Snapshot& snapshot = source.take();
  const auto external = values(snapshot, "external_force"), force = values(snapshot, "force"),
             acceleration = values(snapshot, "acceleration");
  for (Particle p = 0; p < model.body.particles; ++p) {
    const double expected = model.body.position(p).z < 1e-3 ? 0 : -9.81;
    EXPECT_NEAR(acceleration[3 * p + 2], expected, 1e-12) << p;
    EXPECT_NEAR(force[3 * p + 2], expected * model.mass(p), 1e-18) << p;
    EXPECT_EQ(external[3 * p + 2], force[3 * p + 2]) << p;  // no spring pulls yet
    EXPECT_EQ(acceleration[3 * p], 0) << p;
  }
}

/// A body after three steps from random velocities.
struct Shaken {
  std::unique_ptr<Plan> plan;
  const Model& model;
  Simulation simulation;
  double step;

  explicit Shaken(const std::string& scene)
      : plan(plan_of(scene)),
        model(*plan->model),
        simulation(model, 2),
        step(0.5 * model.step_limit.time_step) {
    simulation.set_velocities(
        noise(3 * model.body.particles, 1),
        std::vector<double>(model.degrees_of_freedom == 4 ? model.body.particles : 0));
    for (int n = 0; n < 3; ++n) simulation.step(step);
  }
};

TEST(Snapshot, HasEachFieldOfTheRunWithFiniteNumbers) {
  const Keys none = {{"membrane", "none"}};
  for (const std::string& scene :
       {block(3, 4, 5, membrane_cases[6]),
        block(3, 4, 5, membrane_cases[0], {}, stage("loads.fixed", {{"on", "z_min"}})),
        block(5, 5, 5, none, {}, "lattices.random")}) {
    Shaken body(scene);
    const Model& model = body.model;
    SnapshotSource source(model, body.simulation);
    const Snapshot& snapshot = source.take();
    for (const FieldInfo& field : field_table) {
      Field found;
      EXPECT_EQ(snapshot.field(field.name, found), has_field(model, field.name)) << field.name;
      if (!has_field(model, field.name)) continue;
      ASSERT_EQ(found.values.size(), components_of(field) * model.body.particles) << field.name;
      std::size_t missing = 0;
      for (const double value : found.values) missing += std::isfinite(value) ? 0 : 1;
      // Only corners of a random lattice have too few springs for a strain.
      EXPECT_LE(missing, model.body.is_listed() ? found.values.size() / 20 : 0) << field.name;
    }
    const auto density = values(snapshot, "kinetic_energy_density");
    double kinetic = 0;
    for (Particle p = 0; p < model.body.particles; ++p)
      kinetic += density[p] * model.body.share(p) * model.body.grid.site_volume;
    EXPECT_NEAR(kinetic / body.simulation.kinetic(), 1, 1e-12);
  }
}

/// Laws with a memory are asked as the next step asks them, alone and in composite springs.
TEST(Snapshot, AccelerationIsTheKickOfTheNextStep) {
  const Keys none = {{"membrane", "none"}},
             viscous = {{"type", "materials.viscous"}, {"time", 1e-7}};
  const Stages plastic = Keys{{"type", "materials.plastic"},
                              {"young", 2e10},
                              {"density", 3000},
                              {"yield", 1e5},
                              {"hardening", 0.1},
                              {"region", box({0, 0, 2e-3}, {1, 1, 1})}} +
                         none;
  std::vector<std::string> scenes{
      block(3, 4, 5, membrane_cases[6]),
      block(3, 4, 5, membrane_cases[0], {}, stage("loads.fixed", {{"on", "z_min"}})),
      law_scene(stage("lattices.random", {{"spacing", 1e-3}, {"shape", box_mm(5, 5, 5)}}),
                viscous + none)};
  for (const char* boundary : {"particles", "cells"})
    scenes.push_back(
        law_scene(stage("lattices.cubic",
                        {{"spacing", 1e-3}, {"shape", box_mm(3, 3, 4)}, {"boundary", boundary}}),
                  viscous + none, plastic));
  for (const std::string& scene : scenes) {
    Shaken body(scene);
    SnapshotSource source(body.model, body.simulation);
    const auto acceleration = values(source.take(), "acceleration");
    const std::vector<double> kick(acceleration.begin(), acceleration.end());
    std::vector<double> before, after;
    body.simulation.velocities(before);
    body.simulation.step(body.step);
    body.simulation.velocities(after);
    double most = 0, worst = 0;
    for (std::size_t n = 0; n < kick.size(); ++n) {
      most = std::max(most, std::abs(kick[n]));
      worst = std::max(worst, std::abs((after[n] - before[n]) / body.step - kick[n]));
    }
    EXPECT_LT(worst, 1e-10 * most) << scene;
  }
}

}  // namespace fields_test
