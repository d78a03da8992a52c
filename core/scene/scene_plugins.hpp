// Plugins that a scene brings: the code of a library named in "plugins" runs as soon as the scene
// is read, so scenes from elsewhere may be refused it.
#pragma once

namespace hyperlattice {

/// From here on, in the whole process, a scene that names plugins of its own is wrong input.
void refuse_scene_plugins();
bool refuses_scene_plugins();

}  // namespace hyperlattice
