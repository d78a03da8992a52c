// The template projects of `plugins --new`: one folder for each family, with a plugin called
// my_law, my_lattice, ...
#pragma once

#include <string_view>
#include <vector>

namespace hyperlattice {

struct StarterFile {
  std::string_view path;  ///< "<family>/<file>"
  std::string_view text;
};
extern const std::vector<StarterFile> starter_files;

}  // namespace hyperlattice
