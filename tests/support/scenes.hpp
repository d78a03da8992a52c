// Small scenes for tests. The ordinary runtime plans them, so that tests build nothing that a user
// cannot describe in JSON.
#pragma once

#include <plan/plan.hpp>
#include <state/simulation.hpp>
#include <support/scene_builder.hpp>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace hyperlattice::test {

/// Plans a scene given as text.
inline std::unique_ptr<Plan> plan_of(const std::string& scene, int threads = 1) {
  static int count = 0;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("hyperlattice_scene_" + std::to_string(::getpid()) +
                                                "_" + std::to_string(count++) + ".json");
  std::ofstream(file) << scene;
  Host host;
  auto read = read_scene(file, {}, host);
  std::filesystem::remove(file);
  return make_plan(std::move(read), threads);
}

/// A scene of a free block of nx * ny * nz cells of 1 mm with its corner at the origin; in the
/// cubic lattice each cell holds one particle. `material` holds the keys after young and density.
inline std::string block(int nx, int ny, int nz, const Keys& material = {{"poisson", 0.25}},
                         const Stages& stages = {}, const std::string& lattice = "lattices.cubic") {
  return SceneBuilder{}
      .lattice(lattice, 1e-3, box_mm(nx, ny, nz))
      .material("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// The material's keys for each membrane that the paper names, with a Poisson ratio that it
/// reaches.
struct MembraneCase {
  const char* name;
  const char* material;
  const char* lattice = "lattices.cubic";
};
inline const MembraneCase membrane_cases[] = {
    {"none", R"("poisson": 0.25)"},
    {"I", R"("membrane": "I", "poisson": 0.1)"},
    {"II", R"("membrane": "II", "poisson": 0.1)"},
    {"III", R"("membrane": "III", "lambda": 2)"},
    {"IV", R"("membrane": "IV", "poisson": 0.1)"},
    {"IV_negative", R"("membrane": "IV", "poisson": 0.3)"},
    {"I_m", R"("membrane": "I-m", "poisson": 0.1)"},
    {"I_m_small_ratio", R"("membrane": "I-m", "poisson": 0.23)"},
    {"free", R"("membrane": "free", "k_alpha": 0.5, "k_beta": 1.5, "k_gamma": 0.4)"},
};

/// The same for the volumetric energy of cells, with K_v above zero and below.
inline const MembraneCase volumetric[] = {
    {"nu_0_3", R"("poisson": 0.3)"},
    {"nu_0_45", R"("poisson": 0.45)"},
    {"nu_0_49", R"("poisson": 0.49)"},
};
inline const MembraneCase volumetric_below[] = {
    {"nu_0", R"("poisson": 0, "volumetric": true)"},
    {"nu_minus_0_5", R"("poisson": -0.5, "volumetric": true)"},
};

/// The same for the other structured lattices.
inline const MembraneCase centred_lattices[] = {
    {"bcc", R"("poisson": 0.25)", "lattices.bcc"},
    {"bcc_I_m", R"("membrane": "I-m", "poisson": 0.1)", "lattices.bcc"},
    {"bcc_IV_negative", R"("membrane": "IV", "lambda": -1)", "lattices.bcc"},
    {"fcc", R"("poisson": 0.25)", "lattices.fcc"},
    {"fcc_I_m", R"("membrane": "I-m", "poisson": 0.1)", "lattices.fcc"},
    {"fcc_III", R"("membrane": "III", "lambda": 2)", "lattices.fcc"},
};

/// A block of the lattice and membrane of a case, with more keys of the material.
inline std::string block(int nx, int ny, int nz, const MembraneCase& of, const Keys& more = {},
                         const Stages& stages = {}) {
  return block(nx, ny, nz, of.material + more, stages, of.lattice);
}

/// Values drawn evenly from [-amplitude, amplitude], the same in every run.
inline std::vector<double> noise(std::size_t count, double amplitude, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::vector<double> values(count);
  for (double& value : values)
    value = amplitude * (2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1);
  return values;
}

inline std::vector<double> displacements(const Simulation& simulation) {
  std::vector<double> values;
  simulation.displacements(values);
  return values;
}

/// Largest absolute value; infinite if a value is not finite.
inline double largest(const std::vector<double>& values) {
  double found = 0;
  for (const double value : values)
    found = std::isnan(value) ? HUGE_VAL : std::max(found, std::abs(value));
  return found;
}

/// Largest difference of two fields.
inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) differences[n] = a[n] - b[n];
  return largest(differences);
}

}  // namespace hyperlattice::test
