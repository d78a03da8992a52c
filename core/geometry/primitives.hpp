// The solids that a scene can describe by a key and a few lengths. Each declares its parameters
// once, like a component its options.
#pragma once

#include <base/option_set.hpp>
#include <geometry/region.hpp>

namespace hyperlattice {

struct Primitive {
  std::string_view name, summary;
  OptionSet options;
  std::string_view file_holds;  ///< what the file that the options name must hold, if they name one
  Region (*make)(const void* options) = nullptr;  ///< throws std::runtime_error if a file that the
                                                  ///< options name is no solid, and says why
};

std::span<const Primitive> primitives();

/// The option of a primitive that is a path, relative to the scene.
inline constexpr std::string_view path_option = "file";

}  // namespace hyperlattice
