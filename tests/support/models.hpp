// Models for tests, built from scenes given as text, and the faults of scenes that cannot be built.
#pragma once

#include <model/model.hpp>
#include <support/scene_builder.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace hyperlattice::test {

/// A scene with its model. The scene is declared first, so that the model is destroyed before it.
struct BuiltScene {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Model> model;
  const Model& operator*() const { return *model; }
  const Model* operator->() const { return model.get(); }
};

/// Reads and builds a pipeline without a solver.
inline BuiltScene build(const Stages& pipeline) {
  static int count = 0;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("hyperlattice_model_" + std::to_string(::getpid()) +
                                                "_" + std::to_string(count++) + ".json");
  std::ofstream(file)
      << SceneBuilder{}.stages(pipeline).solver("solvers.explicit", {{"end_time", 1e-6}}).text();
  Host host;
  BuiltScene built;
  try {
    built.scene = read_scene(file, {}, host);
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
  std::filesystem::remove(file);
  built.model = build_model(*built.scene);
  return built;
}

/// The faults of a pipeline, as the user reads them; "" if the pipeline can be built.
inline std::string faults_of(const Stages& pipeline) {
  try {
    build(pipeline);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A lattice stage: a box of nx * ny * nz particles, 1 m apart, with its corner at the origin.
inline Stages box_lattice(int nx, int ny, int nz) {
  return stage("lattices.cubic",
               {{"spacing", 1}, {"shape", box({}, {1.0 * nx, 1.0 * ny, 1.0 * nz})}});
}

/// A material stage with young 1e9, density 1000, and `more` keys.
inline Stages elastic(const Keys& more = {{"poisson", 0.25}}) {
  return stage("materials.elastic", Keys{{"young", 1e9}, {"density", 1000}} + more);
}

}  // namespace hyperlattice::test
