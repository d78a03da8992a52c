// The solids that a scene can describe by a key and a few lengths. Each declares its parameters once, like a component its options.
#pragma once

#include <base/option_set.hpp>
#include <geometry/region.hpp>

namespace hyperlattice {

struct Primitive {
  std::string_view name, summary;
  OptionSet options;
  Region (*make)(const void* options) = nullptr;
};

std::span<const Primitive> primitives();

}  // namespace hyperlattice
