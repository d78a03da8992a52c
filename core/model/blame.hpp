// A run that fails for what a load gave says which load it was.
#pragma once

#include <model/model.hpp>

#include <string>

namespace hyperlattice {

/// Throws RunError: the load with that place in the model, what is wrong with it, and how the scene
/// describes it.
[[noreturn]] void blame_load(const Model& model, std::size_t load, const std::string& what);

}  // namespace hyperlattice
