#include <analyze/calibration_task.hpp>
#include <analyze/curve_family.hpp>
#include <analyze/load_lattice.hpp>
#include <plan/thread_choice.hpp>

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <sstream>

namespace hyperlattice {

namespace {

VirtualTest::Options virtual_test(const CalibrationTask& task) {
  VirtualTest::Options options;
  options.lattice = task.lattice;
  options.particles = task.measure.value_or(options.particles);
  options.strain = task.strain.value_or(options.strain);
  options.threads = chosen_threads(task.threads);
  return options;
}

CurveChoice curve_choice(const CalibrationTask& task) {
  const auto& [from, to, points] = *task.curve;
  return {from, to, points};
}

CalibrationAnswer one_curve(const CalibrationTask& task, Host& host,
                            const VirtualTest::Components& components,
                            const LatticeGeometry& geometry) {
  const CurveChoice choice = curve_choice(task);
  const VirtualTest::Options options = virtual_test(task);
  check_curve(choice, task.choice, geometry);
  std::optional<VirtualTest> test;
  if (task.measure) test.emplace(host, components, options);
  const Curve curve = calibration_curve(choice, task.choice, geometry, test ? &*test : nullptr);
  CalibrationAnswer answer{{{"lattice", task.lattice}}, curve_text(curve, options)};
  answer.json.update(curve_json(curve, options));
  answer.script = curve_script(curve, options);
  answer.width = 1000;
  return answer;
}

/// Computes a curve for each value of one of the lattice's options.
CalibrationAnswer curve_for_each(const CalibrationTask& task, Host& host) {
  const auto equals = task.each.find('=');
  CurveFamily family{task.each.substr(0, equals), {}};
  std::stringstream values(task.each.substr(equals + 1));
  for (std::string value; std::getline(values, value, ',');) {
    std::vector<std::string> options = task.options;
    options.push_back(family.option + "=" + value);
    family.members.push_back(
        {value, calibration_curve(curve_choice(task), task.choice,
                                  load_lattice(host, task.lattice, options), nullptr)});
  }
  CalibrationAnswer answer{{{"lattice", task.lattice}}, family_text(family)};
  answer.json.update(family_json(family, virtual_test(task)));
  answer.script = family_script(family);
  answer.width = 640;
  return answer;
}

}  // namespace

void check(const CalibrationTask& task, Faults& faults) {
  constexpr int least = 3, most = 500;
  if (task.measure && (*task.measure < least || *task.measure > most))
    faults.add("--measure", std::to_string(*task.measure),
               "particles along an edge: " + std::to_string(least) + " to " + std::to_string(most));
  if (task.strain && !task.measure)
    faults.add("--strain", "", "--measure with it: that is the strain of the test");
  if (task.strain && !(std::abs(*task.strain) <= 0.1 && std::abs(*task.strain) >= 1e-9))
    faults.add("--strain", fmt::format("{}", *task.strain),
               "1e-9 to 0.1, positive in compression, negative in tension");
  if (task.each.empty()) return;
  if (!task.curve) faults.add("--each", task.each, "--curve with it: one for each value");
  if (task.measure) faults.add("--each", task.each, "none together with --measure");
  if (const auto equals = task.each.find('=');
      equals == std::string::npos || equals == 0 || equals + 1 == task.each.size())
    faults.add("--each", task.each,
               "an option of the lattice with several values, such as coordination=8.4,13.2");
}

CalibrationAnswer perform(const CalibrationTask& task, Host& host,
                          const VirtualTest::Components& components) {
  if (!task.each.empty()) return curve_for_each(task, host);
  const LatticeGeometry geometry = load_lattice(host, task.lattice, task.options);
  if (geometry.listed && task.measure)
    throw InputError({{"--measure", std::to_string(*task.measure),
                       "none: a listed lattice is calibrated on its periodic sample, and has no "
                       "other test yet"}});
  if (task.curve) return one_curve(task, host, components, geometry);

  const Calibration found = calibrate(task.choice, geometry);
  CalibrationAnswer answer{{{"lattice", task.lattice}, {"parameters", task.choice.parameters}},
                           calibration_text(found)};
  answer.json.update(calibration_json(found));
  if (!task.measure) return answer;
  const VirtualTest::Options options = virtual_test(task);
  const VirtualTestResult measured =
      VirtualTest(host, components, options)
          .measure(found.chosen.ratios, found.chosen.volumetric != 0
                                            ? std::optional(found.infinite.poisson)
                                            : std::nullopt);
  answer.json["measured"] = measured_json(measured, options);
  answer.text += measured_text(measured, options, found.infinite);
  return answer;
}

}  // namespace hyperlattice
