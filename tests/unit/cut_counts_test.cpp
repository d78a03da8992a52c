// What the plan of a lattice with cuts counts and warns of, and the identity of its run.
#include <model/body_figures.hpp>
#include <support/cuts.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

namespace cut_counts_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const Stages elastic_stage =
    stage("materials.elastic", {{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}});

TEST(CutCounts, ClosedSheetAroundAParticleMakesItLoose) {
  const Vec3 low{2.1, 2.1, 1.1}, x{0.8, 0, 0}, y{0, 0.8, 0}, z{0, 0, 0.8};
  const InputText file("around.stl", facets({{low, low + y, low + x},
                                             {low + x + y, low + x, low + y},
                                             {low + z, low + z + x, low + z + y},
                                             {low + z + x + y, low + z + y, low + z + x},
                                             {low, low + x, low + z},
                                             {low + x + z, low + z, low + x},
                                             {low + y, low + y + z, low + x + y},
                                             {low + x + y + z, low + x + y, low + y + z},
                                             {low, low + z, low + y},
                                             {low + y + z, low + y, low + z},
                                             {low + x, low + x + y, low + x + z},
                                             {low + x + y + z, low + x + z, low + x + y}}));
  const auto plan =
      plan_of(SceneBuilder{}
                  .lattice("lattices.cubic", 1, box({}, {6, 5, 4}),
                           {{"cuts", Json::array({Json{{"sheet", {{"file", file.path()}}}}})}})
                  .stages(elastic_stage)
                  .solver("solvers.explicit", {{"end_time", 1e-6}})
                  .text());
  EXPECT_EQ(plan->body.parts.count, 2U);
  EXPECT_EQ(plan->body.parts.loose, 1U);
  EXPECT_EQ(plan->body.cut_springs, 18U);
  EXPECT_EQ(plan->model->body.position(plan->body.parts.first_loose), (Vec3{2.5, 2.5, 1.5}));
  const std::string warning = loose_warning(plan->model->body, plan->body.parts);
  EXPECT_NE(warning.find("1 particle is without springs, the first at (2.5, 2.5, 1.5) m"),
            std::string::npos)
      << warning;
  EXPECT_NE(plan_text(*plan).find("2, which no spring joins; 1 of them is a particle without"),
            std::string::npos)
      << plan_text(*plan);
}

TEST(CutCounts, ContentOfAFileIsPartOfTheIdentity) {
  const auto identity = [](double radius) {
    const InputText file("identity.csv",
                         fmt::format("x,y,z,nx,ny,nz,radius\n3,2,2,0,0,1,{}\n", radius));
    const auto plan =
        plan_of(SceneBuilder{}
                    .lattice("lattices.cubic", 1, box({}, {6, 5, 4}),
                             {{"cuts", Json::array({Json{{"discs", {{"file", file.path()}}}}})}})
                    .stages(elastic_stage)
                    .solver("solvers.explicit", {{"end_time", 1e-6}})
                    .text());
    return identity_hash(plan->identity);
  };
  EXPECT_EQ(identity(2), identity(2));
  EXPECT_NE(identity(2), identity(2.1));
}

}  // namespace cut_counts_test
