// A small study, and the command `hyperlattice study` in a test.
#pragma once

#include <gtest/gtest.h>
#include <support/program.hpp>

#include <cmath>

namespace hyperlattice::test {

/// Two particles joined by a spring. The lower one is held, the upper one starts with 1 mm/s and
/// oscillates. The error of central differences falls with the square of the step.
inline nlohmann::json swinging_pair() {
  return nlohmann::json::parse(R"({
    "format": "hyperlattice-study/1", "title": "Swinging pair",
    "scene": { "format": "hyperlattice/1", "pipeline": [
      { "type": "lattices.cubic", "spacing": "1 mm", "shape": { "box": { "low": [0, 0, 0], "high": ["1 mm", "1 mm", "2 mm"] } } },
      { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500 },
      { "type": "loads.fixed", "on": "z_min" },
      { "type": "loads.start_velocity", "on": "z_max", "linear": [0, 0, "1 mm/s"] },
      { "type": "solvers.explicit", "end_time": "2 us" },
      { "type": "probes.point", "name": "upper", "position": [0, 0, "2 mm"], "component": "z", "every": 0 } ] },
    "vary": {
      "step": { "/pipeline/4/time_step": ["0.2 us", "0.1 us", "0.05 us"] },
      "stiffness": { "/pipeline/1/young": ["10 GPa", "5 GPa"], "labels": ["stiff", "soft"] } },
    "refine": "step",
    "truth": [ { "when": { "stiffness": "stiff" }, "value": 1e-10 }, { "when": { "stiffness": ["soft"] }, "value": 1e-10 } ],
    "compare": { "upper": { "probe": "upper", "column": "displacement_z" } },
    "repeats": 1 })");
}

/// The exact displacement, m: v / omega sin(omega t); omega^2 = k / m = 0.4 E l / (rho l^3).
inline double swing(double young) {
  const double omega = std::sqrt(0.4 * young / 2500) / 1e-3;
  return 1e-3 / omega * std::sin(omega * 2e-6);
}

/// The same study with the exact truths.
inline nlohmann::json true_swinging_pair() {
  nlohmann::json study = swinging_pair();
  study["truth"][0]["value"] = swing(10e9);
  study["truth"][1]["value"] = swing(5e9);
  return study;
}

/// Runs the command on a study in a folder of the test.
class StudyCommand : public testing::Test {
 protected:
  Result study(const nlohmann::json& file, std::vector<std::string> words = {}) {
    std::ofstream(folder_.file("study.json")) << file.dump(1);
    const std::vector<std::string> all{"study", folder_.file("study.json"), "--out", out()};
    words.insert(words.begin(), all.begin(), all.end());
    return run_program(words);
  }
  std::string out() const { return folder_.file("out"); }

  /// Expects exit code 2, no files, a message with all of the parts, and no further faults.
  void expect_refused(const nlohmann::json& file, const std::vector<std::string>& parts,
                      const std::vector<std::string>& words = {}) {
    const Result result = study(file, words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << "missing: " << part << '\n'
                                                          << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'),
              1 + static_cast<std::ptrdiff_t>(parts.size()))
        << result.err;
    EXPECT_FALSE(std::filesystem::exists(out()));
  }

  Folder folder_{"study"};
};

}  // namespace hyperlattice::test
