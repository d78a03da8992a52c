#include "function_set.hpp"

#include <base/errors.hpp>

#include <dlfcn.h>

#include <string>
#include <utility>

namespace hyperlattice::python {

namespace {

thread_local const FunctionSet* present = nullptr;

std::shared_ptr<PythonFunction> find_in_scope(std::string_view name) {
  if (present == nullptr) return nullptr;
  const auto found = present->functions.find(name);
  return found == present->functions.end() ? nullptr : found->second;
}

}  // namespace

FunctionScope::FunctionScope(const FunctionSet* functions) noexcept
    : before_(std::exchange(present, functions)) {}
FunctionScope::~FunctionScope() { present = before_; }

void connect_functions(const std::filesystem::path& library) {
  // The library stays loaded, as all plugins do; the host gets the same one.
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const symbol = handle == nullptr ? nullptr : dlsym(handle, find_function_symbol);
  if (symbol == nullptr) {
    const char* const why = dlerror();
    throw OutsideError(why == nullptr ? library.string() + " cannot be loaded" : why);
  }
  *static_cast<FindFunction*>(symbol) = &find_in_scope;
}

}  // namespace hyperlattice::python
