#include <base/content_hash.hpp>
#include <model/arithmetic.hpp>
#include <plan/identity.hpp>
#include <scene/json.hpp>

#include <hyperlattice/kernels/processor.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>

namespace hyperlattice {

namespace {

using Kind = Dependence::Kind;

constexpr std::string_view kind_names[] = {"scene", "file", "plugin", "program", "mode"};
constexpr std::string_view instruction_names[] = {"baseline", "avx2", "avx512"};

/// Returns the hash of code that this process runs. It is computed once, because loaded code stays
/// the same if its file changes.
std::string hash_of_code(const std::filesystem::path& file) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::string> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [found, is_new] = known.try_emplace(file);
  if (is_new) found->second = hash_of_file(file);
  return found->second;
}

/// Returns the path of the library that contains the core.
std::filesystem::path core_library() {
  Dl_info info{};
  static const int here = 0;
  return dladdr(&here, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "/proc/self/exe";
}

/// Adds each part of the scene separately, so that messages can name a change. The paths of files
/// do not count.
void add_scene(Identity& identity, const Scene& scene) {
  Json parts = Json::parse(scene.resolved);
  parts.erase("plugins");
  for (const InputFile& file : scene.files)
    if (const Json::json_pointer place(file.pointer); parts.contains(place)) parts[place] = nullptr;
  for (const auto& [key, part] : parts.items()) {
    const std::string pointer = member("", key);
    if (!part.is_structured()) {
      identity.push_back({Kind::scene, pointer, {}, hash_of_text(part.dump())});
      continue;
    }
    std::size_t place = 0;
    for (const auto& [name, inner] : part.items())
      identity.push_back({Kind::scene,
                          part.is_array() ? member(pointer, place++) : member(pointer, name),
                          {},
                          hash_of_text(inner.dump())});
  }
}

/// Adds the plugin of a component, unless it is among the `known`.
void add_plugin(Identity& identity, std::set<std::string>& known, const Component& component) {
  if (known.insert(component.plugin).second)
    identity.push_back({Kind::plugin, component.plugin, component.path,
                        component.path.empty() ? component.version : hash_of_code(component.path)});
}

std::string shown(const Dependence& one) {
  switch (one.kind) {
    case Kind::file:
      return fmt::format("{} ({})", one.path.filename().string(), one.name);
    case Kind::plugin:
      return fmt::format("the plugin {} ({})", one.name, one.path.string());
    case Kind::scene:
      return one.name;
    default:
      return "the " + one.name;
  }
}

/// Finds entries of an identity by kind and name; the first of several equal ones.
class Index {
 public:
  explicit Index(const Identity& identity) {
    for (const Dependence& one : identity) entries_.try_emplace({one.kind, one.name}, &one);
  }
  /// Returns the entry of the same kind and name, or null.
  const Dependence* find(const Dependence& wanted) const {
    const auto found = entries_.find({wanted.kind, wanted.name});
    return found == entries_.end() ? nullptr : found->second;
  }

 private:
  std::map<std::pair<Kind, std::string_view>, const Dependence*> entries_;
};

}  // namespace

Identity identity_of(const Scene& scene) {
  Identity identity;
  add_scene(identity, scene);
  for (const InputFile& file : scene.files)
    identity.push_back({Kind::file, file.pointer, file.path, hash_of_file(file.path)});
  std::set<std::string> plugins;
  for (const Stage& stage : scene.stages) {
    add_plugin(identity, plugins, *stage.component);
    for (const Stage& failure : stage.failures) add_plugin(identity, plugins, *failure.component);
  }
  identity.push_back({Kind::program,
                      "program",
                      {},
                      hash_of_text(hash_of_code("/proc/self/exe") + hash_of_code(core_library()))});
  identity.push_back(
      {Kind::mode,
       "instruction set",
       {},
       std::string(instruction_names[static_cast<std::size_t>(processor_instructions())])});
  identity.push_back({Kind::mode, "way of computing springs", {}, spring_arithmetic()});
  return identity;
}

std::string changes(const Identity& before, const Identity& now) {
  std::vector<std::string> found;
  const Index earlier(before), present(now);
  for (const Dependence& one : now) {
    const Dependence* other = earlier.find(one);
    if (other == nullptr)
      found.push_back(shown(one) + " is new");
    else if (other->content != one.content)
      found.push_back(one.kind == Kind::mode ? fmt::format("{} is {} in place of {}", shown(one),
                                                           one.content, other->content)
                                             : shown(one) + " has changed");
  }
  for (const Dependence& one : before)
    if (present.find(one) == nullptr) found.push_back(shown(one) + " is gone");
  constexpr std::size_t most = 4;
  if (found.size() > most) {
    const std::string rest = fmt::format("{} more", found.size() - (most - 1));
    found.resize(most - 1);
    found.push_back(rest);
  }
  if (found.size() < 2) return found.empty() ? "" : found.front();
  const std::string last = std::move(found.back());
  found.pop_back();
  return fmt::format("{}, and {}", fmt::join(found, ", "), last);
}

nlohmann::json identity_json(const Identity& identity) {
  auto list = nlohmann::json::array();
  for (const Dependence& one : identity) {
    auto& entry =
        list.emplace_back(nlohmann::json{{"what", kind_names[static_cast<std::size_t>(one.kind)]},
                                         {"name", one.name},
                                         {"content", one.content}});
    if (!one.path.empty()) entry["path"] = one.path.string();
  }
  return list;
}

Identity read_identity(const nlohmann::json& json) {
  Identity identity;
  if (!json.is_array()) return {};
  for (const nlohmann::json& entry : json) {
    const auto word = [&](const char* key) {
      const auto found = entry.find(key);
      return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const auto kind = std::find(std::begin(kind_names), std::end(kind_names), word("what"));
    if (kind == std::end(kind_names)) return {};
    identity.push_back({static_cast<Kind>(kind - std::begin(kind_names)), word("name"),
                        word("path"), word("content")});
  }
  return identity;
}

std::string identity_hash(const Identity& identity) {
  ContentHash hash;
  for (const Dependence& one : identity)
    hash.add(fmt::format("{} {} {}\n", static_cast<int>(one.kind), one.name, one.content));
  return hash.text();
}

}  // namespace hyperlattice
