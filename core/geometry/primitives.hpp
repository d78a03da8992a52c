// The solids that a scene describes by a key and a few lengths. Each primitive declares its
// parameters as a component declares its options.
#pragma once

#include <base/option_set.hpp>
#include <geometry/region.hpp>

namespace hyperlattice {

/// The declaration of a solid.
struct Primitive {
  std::string_view name, summary;
  OptionSet options;
  /// required content of the file that an option names, if an option does
  std::string_view file_holds;
  /// builds the solid; throws std::runtime_error with the reason if the named file contains no
  /// solid
  Region (*make)(const void* options) = nullptr;
};

/// Returns all primitives.
std::span<const Primitive> primitives();

/// Name of a primitive's option that is a path, relative to the scene.
inline constexpr std::string_view path_option = "file";

}  // namespace hyperlattice
