// The options that name a Python function.
#pragma once

#include "python_function.hpp"

#include <stdexcept>

/// Set by the module hyperlattice._core, see python_function.hpp.
extern "C" HYPERLATTICE_EXPORT hyperlattice::python::FindFunction hyperlattice_find_function;

namespace hyperlattice::python {

struct FunctionOptions {
  std::string function;  ///< its name in the scene
  std::string code;      ///< hash of its code and of the values that the code uses
};

/// Declares these options.
template <class Options>
Schema<Options>& add_function_options(Schema<Options>& schema, std::string_view help) {
  return schema.template add<&Options::function>("function", "", help)
      .template add<&Options::code>(
          "code", "", "hash of the function, which the Python package writes; never given")
      .fallback("\"\"");
}

/// Returns the function; null if this process does not have it.
inline std::shared_ptr<PythonFunction> find(const FunctionOptions& options) {
  return hyperlattice_find_function == nullptr ? nullptr
                                               : hyperlattice_find_function(options.function);
}

inline void check_function(const FunctionOptions& options, const FaultSink& faults) {
  if (!find(options))
    faults.fault("function",
                 "a Python function that this process has. A scene with a Python function runs "
                 "only in Python: hyperlattice.run(scene), where the scene is a dict that holds "
                 "the function itself");
}

inline std::shared_ptr<PythonFunction> found(const FunctionOptions& options) {
  if (std::shared_ptr<PythonFunction> function = find(options)) return function;
  throw std::runtime_error("the Python function " + options.function + " is not in this process");
}

}  // namespace hyperlattice::python
