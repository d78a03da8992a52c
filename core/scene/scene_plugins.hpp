// Permission for plugins of scenes. The code of a library named in "plugins" runs as soon as the
// scene is read, so a program can refuse such libraries in scenes from unknown sources.
#pragma once

namespace hyperlattice {

/// Makes the key "plugins" of scenes an input error, from now on and in the whole process.
void refuse_scene_plugins();
/// Returns whether refuse_scene_plugins() was called.
bool refuses_scene_plugins();

}  // namespace hyperlattice
