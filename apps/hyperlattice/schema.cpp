// hyperlattice schema: prints the JSON Schema of a scene with all components found, for editors.
#include "commands.hpp"

#include <iostream>

namespace hyperlattice {

Command schema_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("schema", "print the JSON Schema of a scene");
  return {command, [] {
            Host host;
            std::cout << scene_schema(host.load_all()) << '\n';
            return exit_done;
          }};
}

}  // namespace hyperlattice
