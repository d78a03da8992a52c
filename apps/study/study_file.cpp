#include <base/input_file.hpp>
#include <scene/settings.hpp>
#include <study/study_file.hpp>

#include <spdlog/spdlog.h>

namespace hyperlattice::study {

namespace {

constexpr std::string_view format = "hyperlattice-study/1";
constexpr const char* needs_truth = "\"truth\" with it: a study without a truth has no errors";

struct Heading {
  struct Options {
    std::string format, title;
    std::optional<std::string> refine;
    Norm error = Norm::relative_l2;
    std::int64_t repeats = 3;
    std::optional<double> target_error;
    std::vector<std::string> peers, cases;
  };
  static Schema<Options> schema() {
    static constexpr std::string_view formats[] = {study::format};
    return Schema<Options>("", "")
        .add<&Options::format>("format", "", "the format of the study")
        .choices(formats)
        .add<&Options::title>("title", "", "what the study shows")
        .fallback("\"\"")
        .add<&Options::refine>("refine", "",
                               "the axis that refines; the one that varies a spacing if left out")
        .add<&Options::error>("error", "", "how the error is counted")
        .choices(norm_names)
        .fallback("\"relative_l2\"")
        .add<&Options::repeats>("repeats", "", "how often each run is timed; the median counts")
        .at_least(1)
        .at_most(99)
        .fallback("3")
        .add<&Options::cases>("cases", "",
                              "axes that change what is asked, such as a material: the cheapest "
                              "setting has to do for all their values")
        .fallback("[]")
        .add<&Options::target_error>("target_error", "",
                                     "the error for which the cheapest setting is sought")
        .positive()
        .add<&Options::peers>("peers", "",
                              "tables of other programs' errors and times: label, error, seconds; "
                              "relative to the study")
        .fallback("[]");
  }
};

class StudyReader {
 public:
  StudyReader(const Json& given, Study& study) : given_(given), study_(study) {}

  void read() {
    if (given_.is_object() && given_.contains("$schema") && !given_["$schema"].is_string())
      faults_.add("/$schema", shown(given_["$schema"]), "the place of a JSON Schema, a text");
    const auto heading = reader_.read<Heading>(
        given_, "", {"$schema", "scene", "set", "vary", "exclude", "truth", "compare"});
    if (!given_.is_object()) return faults_.throw_if_any();
    for (const char* key : {"scene", "vary", "compare"})
      if (!given_.contains(key))
        faults_.add(member("", key), "", fmt::format("\"{}\" (it is required, but missing)", key));
    if (given_.contains("scene")) read_scene_json(given_["scene"]);
    if (given_.contains("vary")) study_.axes = read_axes(given_["vary"], faults_);
    if (given_.contains("exclude")) read_excluded(given_["exclude"]);
    if (given_.contains("truth"))
      study_.truths = read_truths(given_["truth"], folder(), study_.axes, reader_);
    if (given_.contains("compare"))
      study_.comparisons = read_comparisons(given_["compare"], study_.truths, study_.axes, reader_);
    if (heading) take(*heading);
    check_finest();
    if (!given_.contains("truth")) make_sweep();
    faults_.throw_if_any();
    for (const std::string& warning : faults_.warnings()) spdlog::warn("warning: {}", warning);
  }

 private:
  std::filesystem::path folder() const { return study_.file.parent_path(); }

  void take(const Heading::Options& heading) {
    study_.title = heading.title;
    study_.norm = heading.error;
    study_.repeats = heading.repeats;
    study_.target_error = heading.target_error;
    for (std::size_t n = 0; n < heading.peers.size(); ++n)
      append_peers(study_.peers, folder() / heading.peers[n], member("/peers", n), faults_);
    for (std::size_t n = 0; n < heading.cases.size(); ++n) {
      const std::size_t axis =
          find_axis(heading.cases[n], member("/cases", n), study_.axes, faults_);
      if (axis < study_.axes.size()) study_.cases.push_back(axis);
    }
    if (!heading.refine) return find_spacing();
    const std::size_t axis = find_axis(*heading.refine, "/refine", study_.axes, faults_);
    if (axis < study_.axes.size()) study_.refinement = axis;
  }

  /// Sets the refinement to the axis "spacing", or else to the first axis that sets an option
  /// "spacing".
  void find_spacing() {
    const auto sets_spacing = [](const Axis& axis) {
      for (const std::string& pointer : axis.pointers)
        if (pointer.ends_with("/spacing")) return true;
      return false;
    };
    for (std::size_t a = study_.axes.size(); a-- > 0;)
      if (sets_spacing(study_.axes[a])) study_.refinement = a;
    for (std::size_t a = 0; a < study_.axes.size(); ++a)
      if (study_.axes[a].name == "spacing") study_.refinement = a;
  }

  void read_scene_json(const Json& given) {
    study_.scene_file = study_.file;
    if (given.is_string()) {
      study_.scene_file = folder() / given.get<std::string>();
      try {
        const std::string text = read_input_file(study_.scene_file, "/scene",
                                                 "the path of a scene, relative to the study");
        read_scene_text(text);
      } catch (const InputError& error) {
        for (const Fault& fault : error.faults())
          faults_.add(fault.pointer, fault.value, fault.expected);
      }
    } else if (given.is_object()) {
      read_scene_text(given.dump());
    } else {
      faults_.add("/scene", shown(given), "a scene, or the path of one, relative to the study");
    }
    if (given_.contains("set") && study_.scene.json.is_object()) set(given_["set"]);
  }

  void read_scene_text(const std::string& text) {
    Faults faults;
    study_.scene = read_document(text, study_.scene_file, faults);
    for (const Fault& fault : faults.all())
      faults_.add("scene " + fault.pointer, fault.value, fault.expected);
  }

  void set(const Json& changes) {
    if (!changes.is_object())
      return faults_.add("/set", shown(changes),
                         "an object of JSON pointers into the scene, each with a value");
    for (const auto& item : changes.items())
      if (const std::string expected = set_value(study_.scene.json, item.key(), item.value());
          !expected.empty())
        faults_.add(member("/set", item.key()), shown(item.value()), expected);
  }

  void read_excluded(const Json& list) {
    if (!list.is_array())
      return faults_.add(
          "/exclude", shown(list),
          "a list of objects such as {\"boundary\": \"cells\", \"stiffness\": \"eq15\"}");
    for (std::size_t n = 0; n < list.size(); ++n)
      study_.excluded.push_back(
          read_condition(list[n], member("/exclude", n), study_.axes, faults_));
  }

  /// A study without a truth: its values are the same in every repeat.
  void make_sweep() {
    if (!given_.contains("repeats")) study_.repeats = 1;
    check_sweep(study_, "/target_error", "/peers", faults_);
    for (const char* key : {"error", "cases"})
      if (given_.contains(key)) faults_.add(member("", key), shown(given_[key]), needs_truth);
  }

  /// Adds a fault if an extrapolated truth has no refinement or too few sizes.
  void check_finest() {
    for (const Truth& truth : study_.truths) {
      if (truth.kind != Truth::Kind::finest) continue;
      if (!study_.refinement) {
        faults_.add(
            truth.pointer, "\"finest\"",
            "an axis that varies a spacing, or \"refine\" with the name of the axis that refines");
        continue;
      }
      const std::size_t needed = truth.order ? 2 : 3,
                        given = study_.axes[*study_.refinement].values.size();
      if (given < needed)
        faults_.add(
            truth.pointer, "\"finest\"",
            fmt::format("at least {} values of \"{}\" to extrapolate from{}", needed,
                        study_.axes[*study_.refinement].name,
                        truth.order
                            ? ""
                            : ", or 2 and the order of convergence: {\"finest\": {\"order\": 2}}"));
    }
  }

  const Json& given_;
  Study& study_;
  Faults faults_;
  ObjectReader reader_{faults_};
};

}  // namespace

void check_sweep(const Study& study, const std::string& target, const std::string& peers,
                 Faults& faults) {
  if (!study.is_sweep()) return;
  if (study.target_error) faults.add(target, fmt::format("{}", *study.target_error), needs_truth);
  if (!study.peers.empty()) faults.add(peers, "", needs_truth);
}

Study read_study(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  const std::string text = read_input_file(file, "STUDY", "the path of a study");
  Faults faults;
  Json json;
  if (!parse_json(text, json, faults)) faults.throw_if_any();
  apply_settings(json, settings, faults);
  faults.throw_if_any();
  Study study;
  study.file = std::filesystem::absolute(file);
  StudyReader(json, study).read();
  return study;
}

}  // namespace hyperlattice::study
