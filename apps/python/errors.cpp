#include "errors.hpp"

#include <base/errors.hpp>
#include <process/lack_of_memory.hpp>

#include <pybind11/pybind11.h>

#include <filesystem>
#include <new>

namespace hyperlattice::python {

namespace py = pybind11;

namespace {

/// Texts may hold bytes that are not UTF-8, as names of files do.
py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace"));
}

template <class... Arguments>
void raise(const char* name, Arguments&&... arguments) {
  const py::object type = py::module_::import("hyperlattice._errors").attr(name);
  const py::object error = type(std::forward<Arguments>(arguments)...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void raise_scene_error(const InputError& error) {
  py::list faults;
  for (const Fault& fault : error.faults())
    faults.append(py::make_tuple(text(fault.pointer), text(fault.value), text(fault.expected),
                                 text(InputError({fault}).what())));
  raise("SceneError", text(error.what()), faults);
}

}  // namespace

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise_scene_error(error);
    } catch (const RunError& error) {
      raise("RunError", text(error.what()));
    } catch (const OutsideError& error) {
      raise("OutsideError", text(error.what()));
    } catch (const std::filesystem::filesystem_error& error) {
      raise("OutsideError", text(error.what()));
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError, lack_of_memory().c_str());
    } catch (const std::logic_error& error) {
      if (dynamic_cast<const std::invalid_argument*>(&error) != nullptr) throw;  // a ValueError
      PyErr_SetString(PyExc_RuntimeError, error.what());
    }
  });
}

}  // namespace hyperlattice::python
