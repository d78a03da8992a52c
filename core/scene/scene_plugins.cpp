#include <scene/scene_plugins.hpp>

#include <atomic>

namespace hyperlattice {

namespace {

std::atomic<bool> refused = false;

}  // namespace

void refuse_scene_plugins() { refused = true; }
bool refuses_scene_plugins() { return refused; }

}  // namespace hyperlattice
