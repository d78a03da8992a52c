// The file compile_flags of an installation: how plugins are compiled. CMake writes it from the
// settings that it uses for plugins itself.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyperlattice {

struct CompileFlags {
  std::vector<std::filesystem::path> include;          ///< folders of headers
  std::vector<std::string> plugin;                     ///< flags of a plugin's own source
  std::vector<std::string> kernels;                    ///< flags of all kernels
  std::map<std::string, std::vector<std::string>> of;  ///< flags of kernels by instruction set
};

/// Reads the file. Each line is a word and what follows it: "include FOLDER" (relative to the
/// file), "plugin FLAG...", "kernels FLAG...", "instructions NAME FLAG...". Returns nothing read if
/// there is no file.
CompileFlags read_compile_flags(const std::filesystem::path& file);

}  // namespace hyperlattice
