#include "arrays.hpp"

#include <base/errors.hpp>
#include <plan/fields.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace hyperlattice::python {

namespace py = pybind11;

namespace {

void with_state(Job& job, const std::function<void(Simulation&)>& work) {
  const py::gil_scoped_release released;
  job.with_state(work);
}

/// Makes an array that owns the numbers, without a copy.
py::array array_of(std::vector<double> numbers, std::size_t components) {
  auto* const own = new std::vector<double>(std::move(numbers));
  const py::capsule owner(own,
                          [](void* memory) { delete static_cast<std::vector<double>*>(memory); });
  const auto rows = static_cast<py::ssize_t>(own->size() / components);
  if (components == 1) return py::array_t<double>(rows, own->data(), owner);
  return py::array_t<double>({rows, static_cast<py::ssize_t>(components)}, own->data(), owner);
}

/// A field of a run, or one component of it.
struct FieldChoice {
  std::string field;
  std::optional<std::size_t> component;
};

FieldChoice choose(const Model& model, const std::string& name) {
  if (has_field(model, name)) return {name, {}};
  const FieldPart part = find_field_part(name);
  if (part.field != nullptr && has_field(model, part.field->name)) {
    const auto parts = parts_of(part.field->kind);
    return {
        std::string(part.field->name),
        static_cast<std::size_t>(std::find(parts.begin(), parts.end(), part.part) - parts.begin())};
  }
  const auto known = fields_of(model);
  const std::string near = nearest(name, {known.begin(), known.end()});
  throw std::invalid_argument(fmt::format("no field '{}' in this run{}; it has {}", name,
                                          near.empty() ? "" : ": did you mean '" + near + "'?",
                                          fmt::join(known, ", ")));
}

/// A part of the motion by its name: some components of displacement or velocity.
struct MotionPart {
  bool velocity = false;
  py::ssize_t first = 0, count = 3;
};

std::optional<MotionPart> motion_part(const std::string& name) {
  if (name == "height") return MotionPart{false, 3, 1};
  const FieldPart part = find_field_part(name);
  if (part.field == nullptr) return {};
  const bool velocity = part.field->name == "velocity";
  if (!velocity && part.field->name != "displacement") return {};
  if (part.part.empty()) return MotionPart{velocity};
  return MotionPart{velocity, part.part[0] - 'x', 1};
}

template <class Number>
py::array view_of(const Simulation::WholeMotion& motion, const MotionPart& part,
                  py::ssize_t particles, const py::capsule& owner) {
  constexpr py::ssize_t size = sizeof(Number);
  const auto stride = static_cast<py::ssize_t>(motion.component_stride);
  const Number* const first = static_cast<const Number*>(motion.first) + part.first * stride;
  std::vector<py::ssize_t> shape{particles}, strides{size};
  if (part.count > 1) {
    shape.push_back(part.count);
    strides.push_back(stride * size);
  }
  py::array_t<Number> view(shape, strides, first, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

}  // namespace

py::array field_copy(Job& job, const std::string& name) {
  FieldValues values;
  with_state(job, [&](Simulation&) {
    const FieldChoice choice = choose(job.model(), name);
    job.source().take();
    job.source().hand_over(choice.field, values);
    if (!choice.component) return;
    const std::size_t rows = values.numbers.size() / values.components;
    for (std::size_t n = 0; n < rows; ++n)
      values.numbers[n] = values.numbers[n * values.components + *choice.component];
    values.numbers.resize(rows);
    values.components = 1;
  });
  return array_of(std::move(values.numbers), values.components);
}

std::optional<py::array> field_view(const std::shared_ptr<Job>& job, const std::string& name) {
  const std::optional<MotionPart> part = motion_part(name);
  if (!part) return {};
  Simulation::WholeMotion motion;
  bool floats = false;
  py::ssize_t particles = 0;
  with_state(*job, [&](Simulation& simulation) {
    const Model& model = job->model();
    if (part->first + part->count > model.degrees_of_freedom) return;
    motion = simulation.whole_motion(part->velocity);
    floats = model.springs.choice.precision == Precision::floats;
    particles = static_cast<py::ssize_t>(model.body.particles);
  });
  if (motion.first == nullptr) return {};
  const py::capsule owner(new std::shared_ptr<Job>(job),
                          [](void* memory) { delete static_cast<std::shared_ptr<Job>*>(memory); });
  return floats ? view_of<float>(motion, *part, particles, owner)
                : view_of<double>(motion, *part, particles, owner);
}

std::vector<std::string> names_of_fields(Job& job) {
  std::vector<std::string> names;
  with_state(job, [&](Simulation&) {
    const auto known = fields_of(job.model());
    names.assign(known.begin(), known.end());
  });
  return names;
}

py::array positions(Job& job) {
  std::vector<double> numbers;
  with_state(job, [&](Simulation&) {
    const auto known = job.source().take().positions;
    numbers.assign(known.begin(), known.end());
  });
  return array_of(std::move(numbers), 3);
}

void set_motion(Job& job, bool velocity,
                const py::array_t<double, py::array::c_style | py::array::forcecast>& rows) {
  const std::vector<double> xyz(rows.data(), rows.data() + rows.size());
  const bool has_rows = rows.ndim() == 2 && rows.shape(1) == 3;
  with_state(job, [&](Simulation& simulation) {
    const std::uint64_t particles = job.model().body.particles;
    if (!has_rows || xyz.size() != 3 * particles)
      throw std::invalid_argument(
          fmt::format("an array of {} x 3 numbers was expected", particles));
    if (!std::all_of(xyz.begin(), xyz.end(), [](double number) { return std::isfinite(number); }))
      throw std::invalid_argument("the array has a number that is not finite");
    if (!job.can_change())
      throw std::logic_error(
          "the state can be set before the first step and between explicit steps only");
    if (velocity)
      simulation.set_velocities(xyz, {});
    else
      simulation.set_displacements(xyz, {});
    job.source().renew();
  });
}

}  // namespace hyperlattice::python
