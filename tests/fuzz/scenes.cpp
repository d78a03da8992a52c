// Scenes: the whole reading with the built-in plugins, and again for the resolved form, which must
// come out the same.
#include "scene_files.hpp"

#include <scene/scene.hpp>
#include <scene/scene_plugins.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hyperlattice;
  static const std::string file = fuzz::scene_files().file("scene.json");
  static Host host;
  refuse_scene_plugins();
  fuzz::read_or_refuse<InputError>([&] {
    const auto scene = read_scene_text(fuzz::text_of(data, size), file, host);
    fuzz::require(read_scene_text(scene->resolved, file, host)->resolved == scene->resolved);
  });
  return 0;
}
