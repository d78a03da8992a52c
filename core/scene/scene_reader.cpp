#include <scene/common_options.hpp>
#include <scene/expectation.hpp>
#include <scene/option_reader.hpp>
#include <scene/scene_reader.hpp>
#include <scene/settings.hpp>
#include <scene/stage_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

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
                                "folders and libraries of plugins, relative to the scene's folder, "
                                "searched before all others")
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
  SceneReader(const Json& given, Scene& scene, Faults& faults, Catalogue& catalogue)
      : given_(given),
        scene_(scene),
        faults_(faults),
        catalogue_(catalogue),
        regions_(named_regions(), scene.regions, faults, scene.texts, scene.file.parent_path()) {}

  void read() {
    if (!given_.is_object())
      return faults_.add("", shown(given_), "an object with format and pipeline");
    Json resolved;
    OptionReader reader(given_, "", reading(), {"$schema", "regions", "pipeline"});
    if (const auto schema = given_.find("$schema"); schema != given_.end() && !schema->is_string())
      faults_.add("/$schema", shown(*schema),
                  "the place of the JSON Schema that editors check the scene by");
    const OptionsPointer heading = reader.fill(option_set<HeadingSchema>(), resolved);
    if (heading) {
      const auto& given = *static_cast<const Heading*>(heading.get());
      scene_.title = given.title;
      scene_.allow_unstable = given.allow_unstable;
      scene_.precision = given.precision;
      scene_.interface_springs = given.interface_springs;
    }
    read_plugins(resolved);
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
      const auto outcomes =
          catalogue_.add_scene_paths({entries[n].get<std::string>()}, scene_.file.parent_path());
      const SearchOutcome& outcome = outcomes.front();
      if (outcome.absent)
        faults_.add(member("/plugins", n), shown(entries[n]),
                    fmt::format("a folder or library; there is no {}", outcome.path.string()));
      else if (!outcome.accepted)
        refusals_.push_back({member("/plugins", n), shown(entries[n]), outcome.reason});
      else if (!is_utf8(outcome.path.string()))
        faults_.add(member("/plugins", n), shown(entries[n]),
                    fmt::format("a path in UTF-8, and not {}", outcome.path.string()));
      if (resolved.contains("plugins")) resolved["plugins"][n] = outcome.path.string();
    }
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
};

}  // namespace

std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       const std::vector<std::string>& settings,
                                       Catalogue& catalogue) {
  Faults faults;
  Json json;
  if (!parse_json(text, json, faults)) faults.throw_if_any();
  apply_settings(json, settings, faults);
  auto scene = std::make_unique<Scene>();
  scene->file = std::filesystem::absolute(file);
  SceneReader(json, *scene, faults, catalogue).read();
  faults.throw_if_any();
  scene->warnings = faults.warnings();
  return scene;
}

}  // namespace hyperlattice
