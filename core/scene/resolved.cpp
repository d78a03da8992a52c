#include <scene/json.hpp>
#include <scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

/// Returns the deepest folder that contains both paths.
fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end() && *x == *y; ++x, ++y)
    common /= *x;
  return common;
}

bool holds(const fs::path& folder, const fs::path& inner) {
  return common_folder(folder, inner) == folder;
}

}  // namespace

std::string Scene::resolved_in(const fs::path& folder) const {
  Json json = Json::parse(resolved);
  const fs::path from = fs::absolute(folder).lexically_normal(),
                 home = fs::absolute(file).lexically_normal().parent_path();
  const auto name_anew = [&](Json& value) {
    const fs::path path = value.get<std::string>();
    const fs::path together = common_folder(home, path);
    if (together != together.root_path() && holds(together, from))
      value = path.lexically_relative(from).string();
  };
  for (const InputFile& input : files)
    if (const Json::json_pointer place(input.pointer);
        json.contains(place) && json[place].is_string())
      name_anew(json[place]);
  if (json.contains("plugins"))
    for (Json& path : json["plugins"]) name_anew(path);
  return json_text(json);
}

}  // namespace hyperlattice
