#include <host/compile_flags.hpp>

#include <fstream>
#include <sstream>

namespace hyperlattice {

CompileFlags read_compile_flags(const std::filesystem::path& file) {
  CompileFlags flags;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    if (kind == "include") {  // one folder, whose name may have blanks
      std::getline(words >> std::ws, word);
      flags.include.push_back((file.parent_path() / word).lexically_normal());
      continue;
    }
    std::vector<std::string>* list = kind == "plugin"    ? &flags.plugin
                                     : kind == "kernels" ? &flags.kernels
                                                         : nullptr;
    if (kind == "instructions" && words >> word) list = &flags.of[word];
    while (list != nullptr && words >> word) list->push_back(word);
  }
  return flags;
}

}  // namespace hyperlattice
