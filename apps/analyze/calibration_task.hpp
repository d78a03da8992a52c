// The whole of `hyperlattice calibrate`: from what is asked for to the answer as JSON, text and
// picture.
#pragma once

#include <analyze/calibrate.hpp>

#include <nlohmann/json.hpp>

#include <tuple>

namespace hyperlattice {

/// What is asked for; what is not given is empty.
struct CalibrationTask {
  std::string lattice;               ///< type of the lattice component
  std::vector<std::string> options;  ///< of the component, each as "name=value"
  CalibrationChoice choice;
  std::optional<int> measure;    ///< particles along an edge of the virtual test
  std::optional<double> strain;  ///< of that test
  /// Many lambda in place of one: first, last, number of points.
  std::optional<std::tuple<double, double, int>> curve;
  std::string each;  ///< "option=value,value,...": a curve for each value
  int threads = 0;   ///< of the virtual test; 0: see chosen_threads()
};

struct CalibrationAnswer {
  Json json = {};         ///< of `--json`
  std::string text = {};  ///< for people
  /// The picture of a curve as gnuplot commands, and its size in pixels; empty without a curve.
  std::string script = {};
  int width = 0, height = 460;
};

/// Adds a fault for each argument that is out of range or contradicts another one.
void check(const CalibrationTask& task, Faults& faults);

/// Does a checked task. `components`: of the virtual test. Throws as calibrate(), check_curve() and
/// VirtualTest do.
CalibrationAnswer perform(const CalibrationTask& task, Host& host,
                          const VirtualTest::Components& components);

}  // namespace hyperlattice
