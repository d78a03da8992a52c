#include <host/source_plugin.hpp>
#include <scene/common_options.hpp>
#include <scene/document.hpp>
#include <scene/expectation.hpp>
#include <scene/option_reader.hpp>
#include <scene/scene_reader.hpp>
#include <scene/settings.hpp>
#include <scene/stage_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

namespace hyperlattice {

namespace {

constexpr std::string_view format = "hyperlattice/1";

/// The scene's top-level keys that are plain options.
struct Heading {
  std::string format, title;
  std::vector<std::string> plugins;
  bool allow_unstable = false;
  Precision precision = Precision::doubles;
  InterfaceSprings interface_springs = InterfaceSprings::series;
};
struct HeadingSchema {
  using Options = Heading;
  static Schema<Heading> schema() {
    static constexpr std::string_view formats[] = {format};
    return Schema<Heading>("", "")
        .add<&Heading::format>("format", "", "the format of the scene")
        .choices(formats)
        .add<&Heading::title>("title", "", "what the scene shows")
        .fallback("\"\"")
        .add<&Heading::plugins>("plugins", "",
                                "folders, libraries and source files of plugins, relative to the "
                                "scene's folder, searched before all others")
        .fallback("[]")
        .add<&Heading::allow_unstable>("allow_unstable", "", allow_unstable_help)
        .fallback("false")
        .add<&Heading::precision>("precision", "", precision_help)
        .choices(precision_names)
        .fallback("\"double\"")
        .add<&Heading::interface_springs>("interface_springs", "", interface_springs_help)
        .choices(interface_springs_names)
        .fallback("\"series\"");
  }
};

class SceneReader {
 public:
  SceneReader(const Json& given, const Variables& variables, Scene& scene, Faults& faults,
              Catalogue& catalogue)
      : given_(given),
        scene_(scene),
        faults_(faults),
        catalogue_(catalogue),
        regions_(named_regions(), scene.regions, faults, scene.texts, scene.origins, variables) {}

  void read() {
    if (!given_.is_object())
      return faults_.add("", shown(given_), "an object with format and pipeline");
    Json resolved;
    OptionReader reader(given_, "", reading(),
                        {"$schema", "include", "variables", "regions", "pipeline"});
    if (const auto schema = given_.find("$schema"); schema != given_.end() && !schema->is_string())
      faults_.add("/$schema", shown(*schema),
                  "the place of the JSON Schema that editors check the scene by");
    if (const auto include = given_.find("include"); include != given_.end())
      faults_.add("/include", shown(*include),
                  "this key in a file: files are included before --set changes the scene");
    const OptionsPointer heading = reader.fill(option_set<HeadingSchema>(), resolved);
    if (heading) {
      const auto& given = *static_cast<const Heading*>(heading.get());
      scene_.title = given.title;
      scene_.allow_unstable = given.allow_unstable;
      scene_.precision = given.precision;
      scene_.interface_springs = given.interface_springs;
    }
    read_plugins(resolved);
    // Types of a source that did not compile would only be unknown.
    if (!all_compiled_) return finish();
    resolved["regions"] = Json::object();
    if (given_.contains("regions") && !given_["regions"].is_object())
      faults_.add("/regions", shown(given_["regions"]), "an object that gives names to regions");
    regions_.read_named(resolved["regions"]);
    StageReader stages(reading(), catalogue_, refusals_);
    resolved["pipeline"] = stages.read(given_, scene_.stages);
    reader.reject_unknown();
    finish();
    for (const auto& [pointer, path] : regions_.files()) scene_.files.push_back({pointer, path});
    scene_.resolved = json_text(resolved);
  }

 private:
  Reading reading() { return {faults_, regions_, scene_.texts}; }

  const Json& named_regions() const {
    static const Json none = Json::object();
    if (!given_.is_object() || !given_.contains("regions") || !given_["regions"].is_object())
      return none;
    return given_["regions"];
  }

  /// Reads the valid entries also if others are faulty, since their components are needed to check
  /// the stages.
  void read_plugins(Json& resolved) {
    if (!given_.contains("plugins") || !given_["plugins"].is_array()) return;
    const Json& entries = given_["plugins"];
    if (!catalogue_.allows_scene_plugins() && !entries.empty())
      return faults_.add("/plugins", shown(entries),
                         "no plugins of the scene's own, since --no-plugins was given");
    for (std::size_t n = 0; n < entries.size(); ++n) {
      if (!entries[n].is_string()) continue;
      if (has_variable(entries[n].get_ref<const std::string&>())) {
        faults_.add(member("/plugins", n), shown(entries[n]), "a path without variables");
        continue;
      }
      const std::filesystem::path folder = scene_.origins.folder_of(member("/plugins", n));
      const std::filesystem::path source =
          (folder / entries[n].get<std::string>()).lexically_normal();
      std::string entry = entries[n].get<std::string>();
      const bool is_source = is_plugin_source(source) && std::filesystem::is_regular_file(source);
      if (is_source && !compile(source, n, entry)) continue;
      const auto outcomes = catalogue_.add_scene_paths({entry}, folder);
      const SearchOutcome& outcome = outcomes.front();
      if (outcome.absent)
        faults_.add(
            member("/plugins", n), shown(entries[n]),
            fmt::format("a folder, library or source file; there is no {}", outcome.path.string()));
      else if (!outcome.accepted)
        refusals_.push_back({member("/plugins", n), shown(entries[n]), outcome.reason});
      else if (!is_utf8(outcome.path.string()))
        faults_.add(member("/plugins", n), shown(entries[n]),
                    fmt::format("a path in UTF-8, and not {}", outcome.path.string()));
      if (resolved.contains("plugins"))
        resolved["plugins"][n] = is_source ? source.string() : outcome.path.string();
    }
  }

  /// Compiles an entry of "plugins" that is a source file; `library` gets its library. Returns
  /// false after a fault or a refusal.
  bool compile(const std::filesystem::path& source, std::size_t n, std::string& library) {
    const CompiledPlugin compiled = compile_plugin(source);
    const std::string pointer = member("/plugins", n), given = shown(given_["plugins"][n]);
    library = compiled.library.string();
    if (compiled.problem == CompiledPlugin::Problem::source)
      faults_.add(pointer, given, "a source file that can be compiled; " + compiled.sentence);
    else if (compiled.problem == CompiledPlugin::Problem::outside)
      refusals_.push_back({pointer, given, compiled.sentence});
    all_compiled_ = all_compiled_ && compiled.problem == CompiledPlugin::Problem::none;
    return compiled.problem == CompiledPlugin::Problem::none;
  }

  /// Throws InputError if there are faults; refused libraries are then faults, too. Throws
  /// OutsideError if refused libraries are the only fault.
  void finish() {
    if (!faults_.empty())
      for (const Fault& refusal : refusals_)
        faults_.add(refusal.pointer, refusal.value,
                    "a library that can be loaded (" + refusal.expected + ")");
    faults_.throw_if_any();
    std::string message;
    for (const Fault& refusal : refusals_)
      message +=
          fmt::format("{}{}: {}", message.empty() ? "" : "\n", refusal.pointer, refusal.expected);
    if (!message.empty()) throw OutsideError(message);
  }

  const Json& given_;
  Scene& scene_;
  Faults& faults_;
  Catalogue& catalogue_;
  RegionReader regions_;
  // refused libraries: pointer and value of the place that names them, and the reason
  std::vector<Fault> refusals_;
  bool all_compiled_ = true;
};

constexpr const char* variables_key = "variables";

/// Puts the variables into the document. A variable that nothing uses is a warning if the scene's
/// own file defines it: an included file may serve several scenes. It is a fault if only `--set`
/// gives it, since a wrong name would otherwise change nothing.
Variables insert_variables(Document& given, Faults& faults) {
  Json& document = given.json;
  if (!document.is_object()) return {};
  Variables variables;
  const auto found = document.find(variables_key);
  if (found != document.end()) variables = Variables(*found, faults);
  for (auto& [key, value] : document.items())
    if (key != variables_key) variables.insert(value, member("", key), faults);
  for (const std::string& name : variables.names()) {
    if (variables.is_used(name)) continue;
    const std::string pointer = member(member("", variables_key), name);
    if (!given.variables.contains(name))
      faults.add(pointer, shown((*found)[name]),
                 "a variable that the scene uses" +
                     did_you_mean(name, {given.variables.begin(), given.variables.end()}));
    else if (given.origins.is_of_main_file(pointer))
      faults.warn(given.origins.place_of(pointer), "nothing uses this variable");
  }
  return variables;
}

/// Reads a document after its changes.
std::unique_ptr<Scene> read_merged(Document document, const std::filesystem::path& file,
                                   Catalogue& catalogue, Faults& faults) {
  auto scene = std::make_unique<Scene>();
  scene->file = std::filesystem::absolute(file);
  scene->origins = document.origins;
  try {
    const Variables variables = insert_variables(document, faults);
    scene->variables = variables.numbers();
    SceneReader(document.json, variables, *scene, faults, catalogue).read();
    faults.throw_if_any();
  } catch (const InputError& error) {
    throw document.origins.with_places(error);
  }
  scene->warnings = faults.warnings();
  return scene;
}

}  // namespace

std::unique_ptr<Scene> read_scene_document(const Document& document,
                                           const std::filesystem::path& file,
                                           Catalogue& catalogue) {
  Faults faults;
  return read_merged(document, file, catalogue, faults);
}

std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       const std::vector<std::string>& settings,
                                       Catalogue& catalogue) {
  Faults faults;
  Document document = read_document(text, file, faults);
  // without a document, or with a part missing, further faults would be wrong
  if (document.json.is_null() || !document.is_whole) faults.throw_if_any();
  apply_settings(document.json, settings, faults);
  return read_merged(std::move(document), file, catalogue, faults);
}

}  // namespace hyperlattice
