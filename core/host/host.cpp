#include <base/errors.hpp>
#include <base/visible.hpp>
#include <host/component_check.hpp>
#include <host/crash.hpp>
#include <host/gate.hpp>
#include <host/host.hpp>
#include <host/plugin_call.hpp>

#include <boost/core/demangle.hpp>
#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <memory>
#include <set>

namespace hyperlattice {
namespace {

namespace fs = std::filesystem;

const std::string suffix = ".so";

/// Returns one path for each file or folder, whichever links lead to it.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(fs::absolute(path), error);
  if (error) result = fs::absolute(path).lexically_normal();
  return result.has_filename() ? result : result.parent_path();
}

/// Returns the entries of HYPERLATTICE_PLUGIN_PATH. Omits empty entries, which would mean the
/// current folder.
std::vector<fs::path> environment_folders() {
  std::vector<fs::path> folders;
  const char* value = std::getenv("HYPERLATTICE_PLUGIN_PATH");
  std::string_view rest = value ? value : "";
  while (!rest.empty()) {
    const auto end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.emplace_back(resolved(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return folders;
}

/// Returns the folder `hyperlattice` beside this library, in a build and in an installation.
fs::path install_folder() {
  return resolved(boost::dll::this_line_location()).parent_path() / "hyperlattice";
}

/// Extracts the loader's message from Boost's, and demangles the undefined symbol in it.
std::string loader_sentence(std::string message, const fs::path& library) {
  const std::string before = "dlerror system message: ";
  if (const auto begin = message.find(before); begin != message.npos) {
    message.erase(0, begin + before.size());
    if (const auto end = message.rfind("): "); end != message.npos) message.erase(end);
  }
  if (const auto own = library.string() + ": "; message.starts_with(own))
    message.erase(0, own.size());
  const std::string undefined = "undefined symbol: ";
  if (const auto begin = message.find(undefined); begin != message.npos) {
    const auto symbol = message.substr(begin + undefined.size());
    return "cannot be loaded: undefined symbol " + boost::core::demangle(symbol.c_str()) +
           ": link the library that defines it";
  }
  return "cannot be loaded: " + message;
}

/// Loads a library that has passed the gate. It stays loaded until the process ends, since its code
/// may be needed until then.
const boost::dll::shared_library& open(const fs::path& path) {
  static auto& libraries = *new std::vector<std::unique_ptr<boost::dll::shared_library>>;
  try {
    libraries.push_back(std::make_unique<boost::dll::shared_library>(
        path, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local));
  } catch (const std::system_error& error) {
    throw Refusal(loader_sentence(error.what(), path));
  }
  return *libraries.back();
}

const Component* keep(Component component) {
  static auto& components = *new std::vector<std::unique_ptr<Component>>;
  components.push_back(std::make_unique<Component>(std::move(component)));
  return components.back().get();
}

constexpr std::size_t longest_refusal = 8192, longest_version = 200;  // bytes

/// Returns `shown` as a text that lives until the process ends, or `text` itself if both are equal.
std::string_view kept(std::string_view text, std::string shown) {
  static auto& texts = *new std::deque<std::string>;
  return shown == text ? text : texts.emplace_back(std::move(shown));
}
std::string_view shown_line(std::string_view text) {
  return kept(text, visible_line(text, longest_text));
}
std::string_view shown_lines(std::string_view text) {
  return kept(text, visible(text, longest_text));
}

/// Returns a checked component with its texts in visible form.
ComponentInfo shown(ComponentInfo info) {
  static auto& lists = *new std::deque<std::vector<Option>>;
  info.summary = shown_line(info.summary);
  for (std::string_view* text : {&info.equation, &info.source, &info.restrictions})
    *text = shown_lines(*text);
  auto& options = lists.emplace_back(info.options.begin(), info.options.end());
  // one line: JSON allows line ends only between values
  for (Option& option : options)
    for (std::string_view* text : {&option.help, &option.fallback}) *text = shown_line(*text);
  info.options = options;
  return info;
}

/// Returns the components that a library registers, in order of registration. Throws Refusal if one
/// is faulty or comes twice.
std::vector<Component> registered(const fs::path& path) {
  if (const std::string mismatch = gate_mismatch(read_gate(path), own_gate()); !mismatch.empty())
    throw Refusal(mismatch);
  const LoadWatch watch(path.c_str());
  const std::string name = path.stem().string();
  PluginCall call(name, path.c_str(), "load");
  const auto& library = open(path);
  if (!library.has("hyperlattice_plugin"))
    throw Refusal("has a gate but no plugin behind it: write HYPERLATTICE_PLUGIN in it");
  const auto& plugin = library.get<const PluginInfo>("hyperlattice_plugin");

  std::vector<ComponentInfo> infos;
  Registrar registrar(&infos, [](void* self, const ComponentInfo& info) noexcept {
    PluginCall::answer([&] { static_cast<std::vector<ComponentInfo>*>(self)->push_back(info); });
  });
  if (const std::string* sentence = call.failure(plugin.register_components(registrar, call.why())))
    throw Refusal("its registration failed: " + *sentence);
  if (infos.empty()) throw Refusal("registers nothing");

  std::vector<Component> components;
  std::set<std::string_view> names;
  for (const ComponentInfo& info : infos) {
    if (const std::string fault = component_fault(info); !fault.empty()) throw Refusal(fault);
    if (!names.insert(info.name).second)
      throw Refusal("registers " + std::string(info.name) + " twice");
    components.push_back(
        {shown(info), path.stem().string(), visible_line(plugin.version, longest_version), path});
  }
  return components;
}

}  // namespace

Host::Host(std::vector<fs::path> scene_paths) {
  folders_ = environment_folders();
  folders_.push_back(install_folder());
  for (const fs::path& folder : folders_) searched_.push_back(look_into(folder));
  add_scene_paths({scene_paths.begin(), scene_paths.end()}, fs::current_path());
}

std::vector<SearchOutcome> Host::add_scene_paths(const std::vector<std::string>& entries,
                                                 const fs::path& scene_folder) {
  std::vector<SearchOutcome> outcomes;
  std::vector<fs::path> folders;
  for (const std::string& entry : entries) {
    const fs::path path = resolved(scene_folder / entry);
    std::error_code error;
    if (fs::is_regular_file(path, error)) {
      outcomes.push_back(load(path, ""));
      continue;
    }
    if (fs::is_directory(path, error)) folders.push_back(path);
    outcomes.push_back(look_into(path));
    searched_.push_back(outcomes.back());
  }
  folders_.insert(folders_.begin(), folders.begin(), folders.end());
  return outcomes;
}

SearchOutcome Host::look_into(const fs::path& folder) const {
  std::error_code error;
  if (!fs::exists(folder, error)) return {folder, false, true, "no such file or folder"};
  const fs::directory_iterator files(folder, error);
  if (error) return {folder, false, false, "cannot be searched: " + error.message()};
  const auto count = std::count_if(begin(files), end(files), [](const auto& file) {
    return file.path().extension() == suffix && is_type_name(file.path().stem().string());
  });
  return {folder, true, false,
          "has " + std::to_string(count) + (count == 1 ? " library" : " libraries") +
              " named after a type"};
}

std::vector<fs::path> Host::libraries_of(const std::string& type) const {
  std::vector<fs::path> found;
  for (const fs::path& folder : folders_) {
    const fs::path library = resolved(folder / (type + suffix));
    std::error_code error;
    if (fs::exists(library, error) && std::find(found.begin(), found.end(), library) == found.end())
      found.push_back(library);
  }
  return found;
}

/// Returns why a library in the folders cannot be found: it is a link to no file. Empty if there is
/// no such link.
std::string Host::dangling(const std::string& type) {
  for (const fs::path& folder : folders_) {
    const fs::path library = folder / (type + suffix);
    std::error_code error;
    if (fs::exists(library, error) || !fs::is_symlink(fs::symlink_status(library, error))) continue;
    std::string reason = library.filename().string() + ": is a link to " +
                         fs::read_symlink(library, error).string() + ", where nothing is";
    searched_.push_back({library, false, false, reason});
    return reason;
  }
  return "";
}

const Component* Host::refuse(const std::string& type, const std::string& reason) {
  refusals_[type] = reason;
  return nullptr;
}

const Component* Host::find(const std::string& type) {
  if (!is_type_name(type) || refused(type)) return nullptr;
  auto libraries = libraries_of(type);
  const auto known = components_.find(type);
  if (known != components_.end() &&
      std::find(libraries.begin(), libraries.end(), known->second->path) == libraries.end())
    libraries.insert(libraries.begin(), known->second->path);
  if (libraries.size() > 1)
    return refuse(type, "two libraries have " + type + ", " + libraries[0].string() + " and " +
                            libraries[1].string() + ": remove or rename one");
  if (known != components_.end()) return known->second;
  if (libraries.empty()) {
    const std::string reason = dangling(type);
    return reason.empty() ? nullptr : refuse(type, reason);
  }
  const SearchOutcome& outcome = load(libraries.front(), type);
  if (!outcome.accepted) return refuse(type, outcome.reason);
  // A library that was named directly may have been loaded before, for other types.
  const auto given = components_.find(type);
  return given != components_.end()
             ? given->second
             : refuse(type, outcome.path.filename().string() + ": " + outcome.reason +
                                ", not the type it is named after");
}

std::string Host::why_not(const std::string& type) const {
  if (const auto refusal = refusals_.find(type); refusal != refusals_.end()) return refusal->second;
  if (!is_type_name(type)) {
    std::string families;
    for (const std::string_view family : family_names)
      families += (families.empty() ? "" : ", ") + std::string(family);
    return "a type has the form <family>.<name> in small letters, the family one of " + families;
  }
  std::string folders;
  for (const fs::path& folder : folders_)
    folders += (folders.empty() ? "" : ", ") + folder.string();
  return "no library " + type + suffix + " in " + folders;
}

std::vector<std::string> Host::known_types() const {
  std::set<std::string> types;
  for (const auto& [type, component] : components_) types.insert(type);
  for (const fs::path& folder : folders_) {
    std::error_code error;
    for (const auto& file : fs::directory_iterator(folder, error))
      if (file.path().extension() == suffix && is_type_name(file.path().stem().string()))
        types.insert(file.path().stem().string());
  }
  return {types.begin(), types.end()};
}

std::vector<const Component*> Host::load_all() {
  for (const std::string& type : known_types()) find(type);
  return order_;
}

const SearchOutcome& Host::load(const fs::path& library, const std::string& expected_type) {
  for (const SearchOutcome& outcome : searched_)
    if (outcome.path == library) return outcome;
  SearchOutcome outcome;
  outcome.path = library;
  try {
    auto components = registered(library);
    std::string names;
    bool expected = expected_type.empty();
    for (const Component& component : components) {
      if (const auto other = components_.find(component.type()); other != components_.end())
        throw Refusal("registers " + component.type() + ", which " + other->second->path.string() +
                      " registered before: remove or rename one");
      expected = expected || component.type() == expected_type;
      names += (names.empty() ? "" : ", ") + component.type();
    }
    if (!expected)
      throw Refusal("does not register " + expected_type + ", the type it is named after, but " +
                    names);
    for (Component& component : components) {
      order_.push_back(keep(std::move(component)));
      components_[order_.back()->type()] = order_.back();
    }
    outcome.accepted = true;
    outcome.reason = "gives " + names;
  } catch (const Refusal& refusal) {
    outcome.reason =
        visible_line(library.filename().string() + ": " + refusal.what(), longest_refusal);
  } catch (const OutsideError& error) {
    outcome.reason = error.what();
  } catch (const std::exception& error) {
    outcome.reason = library.filename().string() + ": cannot be read: " + error.what();
  }
  return searched_.emplace_back(std::move(outcome));
}

}  // namespace hyperlattice
