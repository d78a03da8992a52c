#include "called_function.hpp"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace hyperlattice::python {

namespace py = pybind11;

namespace {

/// Returns a copy. A function may keep its arrays, and the numbers in the core change.
template <class Number>
py::array_t<Number> copy_of(std::span<const Number> numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}
py::array_t<double> copy_of(std::span<const Vec3> vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return py::array_t<double>({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}},
                             reinterpret_cast<const double*>(vectors.data()));
}
py::array_t<double> rows_of(std::span<const double> numbers, std::uint32_t components) {
  if (components == 1) return copy_of(numbers);
  return py::array_t<double>(
      {static_cast<py::ssize_t>(numbers.size() / components), static_cast<py::ssize_t>(components)},
      numbers.data());
}

/// Calls of the core come from its own threads, which take Python's lock for the whole call. No
/// thread waits for the core while it holds the lock, so that no call can wait for ever.
class CalledFunction final : public PythonFunction {
 public:
  CalledFunction(py::object call, std::shared_ptr<const std::atomic<bool>> is_called)
      : call_(std::move(call)), is_called_(std::move(is_called)) {}
  CalledFunction(const CalledFunction&) = delete;
  CalledFunction& operator=(const CalledFunction&) = delete;
  ~CalledFunction() override {
    if (Py_IsInitialized() == 0) {
      call_.release();  // Python has ended, and its objects with it
      return;
    }
    const py::gil_scoped_acquire lock;
    call_ = py::object();
  }

  void begin(const LoadedBody& body) override {
    locked([&] {
      call_.attr("begin")(copy_of(body.particles), copy_of(body.positions), copy_of(body.masses),
                          copy_of(body.shares));
    });
  }

  void set_forces(const WatchedMotion& motion, std::span<Vec3> forces) override {
    if (!*is_called_) return;
    locked([&] {
      const auto answer = py::array_t<double, py::array::c_style>::ensure(
          call_(motion.time, copy_of(motion.displacement), copy_of(motion.velocity)));
      check_size(answer, 3 * forces.size());
      const double* number = answer.data();
      for (Vec3& force : forces) {
        force = {number[0], number[1], number[2]};
        number += 3;
      }
    });
  }

  void set_broken(const SpringArrays& springs, std::span<std::uint8_t> broken) override {
    if (!*is_called_) return;
    locked([&] {
      const auto answer = py::array_t<bool, py::array::c_style>::ensure(
          call_(springs.time, springs.time_step, copy_of(springs.elongation),
                copy_of(springs.rest_length), copy_of(springs.stiffness), copy_of(springs.rate),
                copy_of(springs.spring_class), copy_of(springs.a), copy_of(springs.b)));
      check_size(answer, broken.size());
      std::copy_n(answer.data(), broken.size(), broken.begin());
    });
  }

  void write(const ShownFrame& frame) override {
    if (!*is_called_) return;
    locked([&] {
      py::dict fields;
      for (const FrameField& field : frame.fields)
        fields[py::str(std::string(field.name))] = rows_of(field.values, field.components);
      call_(frame.time, frame.step, frame.number, copy_of(frame.particles),
            rows_of(frame.positions, 3), fields, py::cpp_function(frame.announce));
    });
  }

 private:
  template <class Work>
  static void locked(const Work& work) {
    const py::gil_scoped_acquire lock;
    std::string sentence;
    try {
      work();
      return;
    } catch (const py::error_already_set& error) {
      sentence = py::str(error.value());
    }
    throw std::runtime_error(sentence);
  }

  static void check_size(const py::array& answer, std::size_t size) {
    if (!answer || static_cast<std::size_t>(answer.size()) != size)
      throw std::runtime_error("the Python function returned another array than was checked");
  }

  py::object call_;
  std::shared_ptr<const std::atomic<bool>> is_called_;
};

}  // namespace

std::shared_ptr<FunctionSet> function_set(const py::dict& calls) {
  auto set = std::make_shared<FunctionSet>();
  for (const auto& [name, call] : calls)
    set->functions.emplace(py::cast<std::string>(name),
                           std::make_shared<CalledFunction>(
                               py::reinterpret_borrow<py::object>(call), set->are_called));
  return set;
}

}  // namespace hyperlattice::python
