// The error of a run that fails because of a load; it names the load.
#pragma once

#include <model/model.hpp>

#include <string>

namespace hyperlattice {

/// Throws RunError that names the load with index `load` in the model, what is wrong (`what`), and
/// the scene's text of the load.
[[noreturn]] void blame_load(const Model& model, std::size_t load, const std::string& what);

}  // namespace hyperlattice
