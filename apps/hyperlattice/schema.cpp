// hyperlattice schema: prints the JSON Schema of a scene with all components found, for editors.
#include "commands.hpp"

#include <iostream>

namespace hyperlattice {

Command schema_command(CLI::App& program) {
  const auto plugin_paths = std::make_shared<PluginPathArgument>();
  CLI::App* command = program.add_subcommand("schema", "print the JSON Schema of a scene");
  plugin_paths->declare(*command);
  return {command, [plugin_paths] {
            Host host(plugin_paths->libraries());
            std::cout << scene_schema(host.load_all()) << '\n';
            return exit_done;
          }};
}

}  // namespace hyperlattice
