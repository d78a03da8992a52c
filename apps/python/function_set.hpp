// The Python functions of one scene, and the thread that reads or runs this scene.
#pragma once

#include "functions/python_function.hpp"

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace hyperlattice::python {

struct FunctionSet {
  std::map<std::string, std::shared_ptr<PythonFunction>, std::less<>> functions;
  /// Whether the functions are called. A plan tries components with states that no run has, which
  /// functions must not see.
  std::shared_ptr<std::atomic<bool>> are_called = std::make_shared<std::atomic<bool>>(false);
};

/// Says, while it exists, that the present thread reads or runs the scene of these functions.
/// `functions`: may be null, and outlives the scope.
class FunctionScope {
 public:
  explicit FunctionScope(const FunctionSet* functions) noexcept;
  FunctionScope(const FunctionScope&) = delete;
  FunctionScope& operator=(const FunctionScope&) = delete;
  ~FunctionScope();

 private:
  const FunctionSet* const before_;
};

/// Lets the plugin of python_functions.cpp find the functions. Throws OutsideError if the library
/// cannot be loaded.
void connect_functions(const std::filesystem::path& library);

}  // namespace hyperlattice::python
