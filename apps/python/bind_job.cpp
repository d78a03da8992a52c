#include "arrays.hpp"
#include "bindings.hpp"
#include "called_function.hpp"
#include "job.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <spdlog/fmt/fmt.h>

#include <limits>

namespace hyperlattice::python {

namespace py = pybind11;

namespace {

/// Asks the state for a value.
template <class Ask>
auto ask(Job& job, const Ask& question) {
  std::invoke_result_t<Ask, Simulation&> answer{};
  const py::gil_scoped_release released;
  job.with_state([&](Simulation& simulation) { answer = question(simulation); });
  return answer;
}

py::dict energy(Job& job) {
  const EnergyBalance b = ask(job, [](Simulation& simulation) { return simulation.balance(); });
  py::dict energies;
  energies["kinetic"] = b.kinetic;
  energies["stored"] = b.stored;
  energies["dissipated"] = b.dissipated();
  energies["injected"] = b.injected;
  energies["error"] = b.error;
  energies["relative_error"] = b.relative_error();
  return energies;
}

std::shared_ptr<Job> make_job(std::optional<std::string> text, std::filesystem::path file,
                              std::vector<std::string> settings, int threads,
                              const py::dict& functions, std::filesystem::path out, bool resume,
                              bool overwrite, double checkpoint_every, bool stays) {
  RunOptions options;
  options.directory = std::move(out);
  options.resume = resume;
  options.overwrite = overwrite;
  options.checkpoint_every = checkpoint_every;
  return make_waiting<Job>(SceneSource{std::move(text), std::move(file), std::move(settings),
                                       threads, function_set(functions)},
                           std::move(options), stays);
}

}  // namespace

void bind_job(py::module_& core) {
  const auto released = py::call_guard<py::gil_scoped_release>();
  py::class_<Job, std::shared_ptr<Job>>(core, "Job")
      .def(py::init(&make_job), py::kw_only(), py::arg("text"), py::arg("file"),
           py::arg("settings"), py::arg("threads"), py::arg("functions"), py::arg("out"),
           py::arg("resume"), py::arg("overwrite"), py::arg("checkpoint_every"), py::arg("stays"))
      .def("wait", &Job::wait, py::arg("seconds"), released)
      .def("go_on", &Job::go_on, py::arg("steps") = std::numeric_limits<std::uint64_t>::max(),
           py::arg("time") = std::numeric_limits<double>::infinity(), released)
      .def("pause", &Job::pause)
      .def("stop", &Job::stop, released)
      .def("give_up", &Job::give_up, released)
      .def("has_ended", &Job::has_ended, released)
      .def("exit_code", &Job::exit_code, released)
      .def("plan_text", &Job::plan_text, released)
      .def("take_log", &Job::take_log, released)
      .def("reached",
           [](const Job& job) {
             const Reached reached = job.reached();
             return py::make_tuple(reached.steps, reached.time, reached.time_step,
                                   reached.planned_steps);
           })
      .def("field_copy", &field_copy, py::arg("name"))
      .def("field_view", &field_view, py::arg("name"))
      .def("fields", &names_of_fields)
      .def("positions", &positions)
      .def("set_motion", &set_motion, py::arg("velocity"), py::arg("rows"))
      .def("energy", &energy)
      .def("state_hash",
           [](Job& job) {
             return fmt::format("{:016x}",
                                ask(job, [](Simulation& simulation) { return simulation.hash(); }));
           })
      .def("broken_springs", [](Job& job) {
        return ask(job, [](Simulation& simulation) { return simulation.broken(); });
      });
}

}  // namespace hyperlattice::python
