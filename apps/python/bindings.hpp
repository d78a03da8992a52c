// The parts of the module hyperlattice._core. Its functions are for the package, not for users.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <memory>
#include <utility>

namespace hyperlattice::python {

/// Makes an object whose destructor runs without Python's lock, because it waits for a thread. In a
/// process that fork() made, the thread does not exist: there the object is left as it is.
template <class T, class... Arguments>
std::shared_ptr<T> make_waiting(Arguments&&... arguments) {
  return std::shared_ptr<T>(new T(std::forward<Arguments>(arguments)...),
                            [owner = getpid()](T* object) {
                              if (getpid() != owner) return;
                              const pybind11::gil_scoped_release released;
                              delete object;
                            });
}

void bind_job(pybind11::module_& core);    ///< class Job
void bind_tools(pybind11::module_& core);  ///< class Background, plan, study, analyze, calibrate

}  // namespace hyperlattice::python
