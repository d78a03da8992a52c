// The argument --plugin-path, shared by `plugins` and `schema`.
#include "commands.hpp"

#include <host/source_plugin.hpp>

namespace hyperlattice {

void PluginPathArgument::declare(CLI::App& command) {
  command
      .add_option(
          "--plugin-path", paths,
          "a folder to look into before all others, a library or a source file; may be given "
          "several times")
      ->type_name("PATH")
      ->allow_extra_args(false);
}

std::vector<std::filesystem::path> PluginPathArgument::libraries() const {
  std::vector<std::filesystem::path> found = paths;
  for (std::filesystem::path& path : found) {
    if (!is_plugin_source(path) || !std::filesystem::is_regular_file(path)) continue;
    const CompiledPlugin compiled = compile_plugin(path);
    if (compiled.problem == CompiledPlugin::Problem::source)
      throw InputError({{"--plugin-path", path.string(),
                         "a source file that can be compiled; " + compiled.sentence}});
    if (compiled.problem == CompiledPlugin::Problem::outside) throw OutsideError(compiled.sentence);
    path = compiled.library;
  }
  return found;
}

}  // namespace hyperlattice
