// Ownership of a component that a plugin made.
#pragma once

#include <scene/scene.hpp>

#include <memory>

namespace hyperlattice {

/// Destroys a component through its plugin. If the destructor crashes, the last line of the program
/// names the plugin.
struct Destroy {
  const Component* of = nullptr;
  void operator()(void* made) const;
};
/// A component made from its stage. The plugin that made it destroys it.
using ComponentPointer = std::unique_ptr<void, Destroy>;
/// Makes the component of a stage. Throws InputError at the stage's pointer if the component
/// refuses its options.
ComponentPointer make_component(const Stage& stage);

}  // namespace hyperlattice
