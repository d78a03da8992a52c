// The commands plan, study, analyze and calibrate, whose JSON the package returns.
#include "background.hpp"
#include "bindings.hpp"
#include "called_function.hpp"
#include "scene_source.hpp"

#include <analyze/analysis.hpp>
#include <analyze/calibration_task.hpp>
#include <analyze/crystal_report.hpp>
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
          const py::dict& functions, std::filesystem::path out) {
  return make_waiting<Background>(
      [source = SceneSource{std::move(text), std::move(file), std::move(settings), threads,
                            function_set(functions)},
       out = std::move(out)] {
        const FunctionScope scope(source.functions.get());
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

/// The analysis of a lattice, of cubic crystals (`crystals`: their file), or of both.
Work analyze(const py::dict& membrane, std::string lattice, Texts options, std::string crystals) {
  return make_waiting<Background>([choice = membrane_of(membrane), lattice = std::move(lattice),
                                   options = std::move(options), crystals = std::move(crystals)] {
    check_environment();
    Json json = {{"lattice", lattice}};
    const auto fitted =
        crystals.empty() ? std::vector<FittedCrystal>{} : fit_all(read_crystals(crystals));
    if (!choice.membrane.empty()) {
      Host host;
      const LatticeGeometry geometry = load_lattice(host, lattice, options);
      const ChosenMembrane chosen = resolve(choice, geometry);
      json.update(chosen_json(chosen));
      json.update(analysis_json(analyse(lattice_of(chosen, geometry))));
    }
    if (!fitted.empty()) json.update(crystals_json(fitted));
    return json_text(json);
  });
}

Work calibrate_springs(const py::dict& membrane, std::string lattice, Texts options,
                       std::optional<double> young, std::optional<double> spacing,
                       std::string parameters, std::optional<int> measure,
                       std::optional<double> strain,
                       std::optional<std::tuple<double, double, int>> curve, std::string each,
                       int threads) {
  return make_waiting<Background>(
      [task = CalibrationTask{std::move(lattice),
                              std::move(options),
                              {membrane_of(membrane), young, spacing, std::move(parameters)},
                              measure,
                              strain,
                              curve,
                              std::move(each),
                              threads}] {
        check_environment();
        Faults faults;
        check(task, faults);
        faults.throw_if_any();
        Host host;
        return json_text(perform(task, host, bundled::virtual_test).json);
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
           py::arg("threads"), py::arg("functions"), py::arg("out"));
  core.def("study", study, py::kw_only(), py::arg("file"), py::arg("settings"), py::arg("out"),
           py::arg("target_error"), py::arg("peers"), py::arg("fresh"), py::arg("threads"));
  core.def("analyze", analyze, py::kw_only(), py::arg("membrane"), py::arg("lattice"),
           py::arg("options"), py::arg("crystals"));
  core.def("calibrate", calibrate_springs, py::kw_only(), py::arg("membrane"), py::arg("lattice"),
           py::arg("options"), py::arg("young"), py::arg("spacing"), py::arg("parameters"),
           py::arg("measure"), py::arg("strain"), py::arg("curve"), py::arg("each"),
           py::arg("threads"));
}

}  // namespace hyperlattice::python
