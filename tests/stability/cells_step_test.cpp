// The critical time step of a body of cells also holds for edges, corners and single cells. For a
// body of one cell the step is exact.
#include <support/cells.hpp>
#include <support/growth.hpp>

#include <gtest/gtest.h>

namespace cells_step_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

class CellsStep : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Membranes, CellsStep, testing::ValuesIn(membrane_cases),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(Volumetric, CellsStep, testing::ValuesIn(volumetric),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(VolumetricBelow, CellsStep, testing::ValuesIn(volumetric_below),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(CellsStep, HoldsForEveryShape) {
  for (const CellShape& shape : cell_shapes())
    EXPECT_LT(growth(*plan_of(scene_of_cells(shape.shape, GetParam().material))->model, 0.99), 100)
        << shape.name;
}

TEST_P(CellsStep, IsExactForOneCell) {
  const auto plan = plan_of(scene_of_cells(box_mm(1, 1, 1), GetParam().material));
  EXPECT_GT(growth(*plan->model, 1.02), 1e6);
}

TEST_P(CellsStep, HoldsForSeveralMaterials) {
  const Json part = {{"half_space", {{"point", {2e-3, 0, 0}}, {"normal", {-1, 0.2, 0}}}}};
  const Stages other =
      stage("materials.elastic",
            Keys{{"young", 3e10}, {"density", 700}, {"region", part}} + GetParam().material);
  for (const CellShape& shape : cell_shapes()) {
    if (shape.cells().size() < 30) continue;  // too small for two materials
    EXPECT_LT(
        growth(*plan_of(scene_of_cells(shape.shape, GetParam().material, other))->model, 0.99), 100)
        << shape.name;
  }
}

}  // namespace cells_step_test
