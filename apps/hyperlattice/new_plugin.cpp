// hyperlattice plugins --new failures.tearing: a project that builds, tests and shows a plugin of
// that name.
#include "commands.hpp"
#include "starters.hpp"

#include <base/errors.hpp>
#include <host/source_plugin.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>

namespace hyperlattice {
namespace {

/// Returns the class name of "tearing_apart", "TearingApart".
std::string class_name(std::string_view name) {
  std::string result;
  bool begins = true;
  for (const char letter : name) {
    if (letter != '_')
      result += begins && letter >= 'a' ? static_cast<char>(letter - 'a' + 'A') : letter;
    begins = letter == '_';
  }
  return result;
}

std::string replaced(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Returns the name of a family's template, from its source file: "my_law".
std::string starter_name(const std::string& family) {
  for (const StarterFile& file : starter_files)
    if (file.path.starts_with(family + "/my_") && file.path.ends_with(".cpp"))
      return std::filesystem::path(file.path).stem().string();
  return "";
}

bool is_name(std::string_view name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         std::all_of(name.begin(), name.end(), fits);
}

/// Returns a text of the template with the plugin's names in it.
std::string named(std::string_view text, const std::string& starter, const std::string& name) {
  return replaced(replaced(std::string(text), starter, name), class_name(starter),
                  class_name(name));
}

/// Writes the plugin as one source file, which a scene can name in "plugins".
int write_source(const std::string& family, const std::string& name,
                 const std::filesystem::path& file) {
  if (std::filesystem::exists(file))
    throw InputError({{"--out", file.string(), "a name that is free"}});
  const std::string starter = starter_name(family);
  const auto find = [&](const char* suffix) {
    return std::find_if(starter_files.begin(), starter_files.end(), [&](const StarterFile& one) {
      return one.path == fmt::format("{}/{}.{}", family, starter, suffix);
    });
  };
  if (find("hpp") != starter_files.end())
    throw InputError({{"--new", fmt::format("{}.{}", family, name),
                       "a family whose project has one source, for a single file; leave out --out "
                       "for a project"}});
  write_file(file.string(), named(find("cpp")->text, starter, name));
  const std::string type = fmt::format("{}.{}", family == "surfaces" ? "failures" : family, name);
  spdlog::info(
      "{} in {}: name it in a scene as \"plugins\": [\"{}\"], test it with\n  hyperlattice "
      "plugins --test {} --plugin-path {}",
      type, file.string(), file.filename().string(), type, file.string());
  return exit_done;
}

}  // namespace

int write_new_plugin(const std::string& type, std::filesystem::path folder) {
  const std::size_t dot = type.find('.');
  const std::string family = type.substr(0, dot),
                    name = dot == std::string::npos ? "" : type.substr(dot + 1);
  std::set<std::string_view> families;
  for (const StarterFile& file : starter_files)
    families.insert(file.path.substr(0, file.path.find('/')));
  if (families.count(family) == 0 || !is_name(name))
    throw InputError(
        {{"--new", type,
          fmt::format("one of {}, a dot, and a name of small letters, digits and underscores",
                      fmt::join(families, ", "))}});
  if (is_plugin_source(folder)) return write_source(family, name, folder);
  if (folder.empty()) folder = name;
  if (std::filesystem::exists(folder))
    throw InputError({{"--out", folder.string(), "a folder that is not there yet"}});

  const std::string starter = starter_name(family);
  std::filesystem::create_directories(folder);
  for (const StarterFile& file : starter_files) {
    if (file.path.substr(0, file.path.find('/')) != family) continue;
    write_file((folder / named(file.path.substr(family.size() + 1), starter, name)).string(),
               named(file.text, starter, name));
  }
  spdlog::info(
      "{} in {}: build and test it with\n  cmake -S {} -B {}/build && cmake --build {}/build && "
      "ctest --test-dir {}/build",
      type, folder.string(), folder.string(), folder.string(), folder.string(), folder.string());
  return exit_done;
}

}  // namespace hyperlattice
