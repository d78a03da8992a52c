// A Python function that components of a scene call. The objects on the side of Python are those of
// hyperlattice/_functions.py: they check what the function returns.
#pragma once

#include "function_set.hpp"

#include <pybind11/pybind11.h>

#include <memory>

namespace hyperlattice::python {

/// Makes the set from a dict of names and of calls, see _functions.py. Call it with Python's lock.
std::shared_ptr<FunctionSet> function_set(const pybind11::dict& calls);

}  // namespace hyperlattice::python
