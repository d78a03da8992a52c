// The commands plan, study, analyze and calibrate, whose JSON the package returns.
#include "background.hpp"
#include "bindings.hpp"
#include "scene_source.hpp"

#include <analyze/analysis.hpp>
#include <analyze/calibrate.hpp>
#include <analyze/load_lattice.hpp>
#include <hyperlattice/components.hpp>
#include <plan/calibration.hpp>
#include <plan/shortage.hpp>
#include <plan/thread_choice.hpp>
#include <process/environment.hpp>
#include <study/perform.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

namespace hyperlattice::python {

namespace py = pybind11;

namespace {

using Texts = std::vector<std::string>;
using Work = std::shared_ptr<Background>;

/// The plan as JSON and as text.
Work plan(std::optional<std::string> text, std::filesystem::path file, Texts settings, int threads,
          std::filesystem::path out) {
  return make_waiting<Background>(
      [source = SceneSource{std::move(text), std::move(file), std::move(settings), threads},
       out = std::move(out)] {
        const std::unique_ptr<Plan> plan = plan_of(source);
        for (std::string& missing : shortages(*plan, out))
          plan->model->warnings.push_back(std::move(missing));
        calibrate_run_time(*plan);
        return json_text(nlohmann::json{{"plan", plan_json(*plan)}, {"text", plan_text(*plan)}});
      });
}

/// The study as JSON, and whether it was interrupted.
Work study(std::filesystem::path file, Texts settings, std::filesystem::path out,
           std::optional<double> target_error, std::vector<std::filesystem::path> peers, bool fresh,
           int threads) {
  return make_waiting<Background>([=] {
    check_environment();
    study::Study study = study::read_study(file, settings);
    if (target_error) study.target_error = *target_error;
    Faults faults;
    for (const auto& table : peers) study::append_peers(study.peers, table, "peers", faults);
    faults.throw_if_any();
    Host host;
    const auto [done, findings] = study::perform(
        study, {.directory = out, .threads = chosen_threads(threads), .fresh = fresh}, host);
    return json_text(Json{{"interrupted", done.interrupted},
                          {"study", study::study_json(study, done.rows, findings)}});
  });
}

MembraneChoice membrane_of(const py::dict& choice) {
  const auto number = [&](const char* key) {
    return choice.contains(key) && !choice[key].is_none()
               ? std::optional(choice[key].cast<double>())
               : std::nullopt;
  };
  MembraneChoice membrane;
  membrane.membrane = choice["membrane"].cast<std::string>();
  membrane.poisson = number("poisson");
  membrane.lambda = number("lambda");
  if (choice.contains("k_alpha") && !choice["k_alpha"].is_none())
    membrane.k_alpha = choice["k_alpha"].cast<std::string>();
  membrane.k_beta = number("k_beta");
  membrane.k_gamma = number("k_gamma");
  return membrane;
}

Work analyze(const py::dict& membrane, std::string lattice, Texts options) {
  return make_waiting<Background>(
      [choice = membrane_of(membrane), lattice = std::move(lattice), options = std::move(options)] {
        check_environment();
        Host host;
        const LatticeGeometry geometry = load_lattice(host, lattice, options);
        const ChosenMembrane chosen = resolve(choice, geometry);
        Json json = {{"lattice", lattice}};
        json.update(chosen_json(chosen));
        json.update(analysis_json(analyse(lattice_of(chosen, geometry))));
        return json_text(json);
      });
}

Work calibrate_springs(const py::dict& membrane, std::string lattice, Texts options,
                       std::optional<double> young, std::optional<double> spacing,
                       std::string parameters, std::optional<int> measure,
                       std::optional<double> strain, int threads) {
  CalibrationChoice choice{membrane_of(membrane), young, spacing, std::move(parameters)};
  return make_waiting<Background>([=, lattice = std::move(lattice), options = std::move(options)] {
    check_environment();
    Host host;
    const LatticeGeometry geometry = load_lattice(host, lattice, options);
    if (geometry.listed && measure)
      throw InputError({{"measure", std::to_string(*measure),
                         "none: a listed lattice is calibrated on its periodic sample, and has no "
                         "other test yet"}});
    const Calibration found = calibrate(choice, geometry);
    Json json = {{"lattice", lattice}, {"parameters", choice.parameters}};
    json.update(calibration_json(found));
    if (measure) {
      VirtualTest::Options test;
      test.lattice = lattice;
      test.particles = *measure;
      test.strain = strain.value_or(test.strain);
      test.threads = chosen_threads(threads);
      const VirtualTestResult measured =
          VirtualTest(host, bundled::virtual_test, test)
              .measure(found.chosen.ratios, found.chosen.volumetric != 0
                                                ? std::optional(found.infinite.poisson)
                                                : std::nullopt);
      json["measured"] = measured_json(measured, test);
    }
    return json_text(json);
  });
}

}  // namespace

void bind_tools(py::module_& core) {
  const auto released = py::call_guard<py::gil_scoped_release>();
  py::class_<Background, Work>(core, "Background")
      .def("wait", &Background::wait, py::arg("seconds"), released)
      .def("result", &Background::result, released)
      .def("take_log", &Background::take_log, released);
  core.def("plan", plan, py::kw_only(), py::arg("text"), py::arg("file"), py::arg("settings"),
           py::arg("threads"), py::arg("out"));
  core.def("study", study, py::kw_only(), py::arg("file"), py::arg("settings"), py::arg("out"),
           py::arg("target_error"), py::arg("peers"), py::arg("fresh"), py::arg("threads"));
  core.def("analyze", analyze, py::kw_only(), py::arg("membrane"), py::arg("lattice"),
           py::arg("options"));
  core.def("calibrate", calibrate_springs, py::kw_only(), py::arg("membrane"), py::arg("lattice"),
           py::arg("options"), py::arg("young"), py::arg("spacing"), py::arg("parameters"),
           py::arg("measure"), py::arg("strain"), py::arg("threads"));
}

}  // namespace hyperlattice::python
