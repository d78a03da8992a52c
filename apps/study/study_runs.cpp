#include <base/errors.hpp>
#include <base/folder_file.hpp>
#include <plan/plan.hpp>
#include <process/lack_of_memory.hpp>
#include <run/history.hpp>
#include <run/interrupt.hpp>
#include <run/occupancy.hpp>
#include <run/run.hpp>
#include <study/checks.hpp>
#include <study/study_runs.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <new>

namespace hyperlattice::study {

namespace {

namespace fs = std::filesystem;

/// Turns the log off during its life, since a study has its own line for each run.
class QuietLog {
 public:
  QuietLog() : before_(spdlog::get_level()) { spdlog::set_level(spdlog::level::off); }
  ~QuietLog() { spdlog::set_level(before_); }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

 private:
  spdlog::level::level_enum before_;
};

/// Returns the summary of a run; null if there is none, discarded if it is invalid.
Json summary_in(const fs::path& folder) {
  const auto file = read_folder_file(folder, "summary.json", largest_json);
  if (!file) return {};
  Json summary = Json::parse(file->text, nullptr, false);
  return summary.is_object() ? summary : Json(Json::value_t::discarded);
}

/// Returns the name of the variable at a JSON pointer into a scene; empty for other pointers.
std::string variable_at(const std::string& pointer) {
  constexpr std::string_view above = "/variables/";
  return pointer.starts_with(above) ? pointer.substr(above.size()) : "";
}

/// A run that exists already.
struct EarlierRun {
  Json summary;         ///< null if the run does not exist, is not done, or cannot be reused
  std::string changed;  ///< why a finished run cannot be reused
};

/// Returns the finished run in a folder if it depends on the same input as the new run and used the
/// same number of threads, which changes its times.
EarlierRun find_earlier(const fs::path& folder, const Scene& scene, const Identity& identity,
                        Threads threads) {
  EarlierRun earlier{summary_in(folder), ""};
  if (earlier.summary.is_discarded()) return {nullptr, "its summary.json cannot be read"};
  const Json status = earlier.summary.is_null() ? Json() : earlier.summary.value("status", Json());
  if (status != "done") return {};
  const Json counted = earlier.summary.value("threads", Json()),
             wall = earlier.summary.value("wall_seconds", Json());
  if (!counted.is_number_integer() || !threads.allow(counted.get<std::int64_t>()))
    earlier.changed = fmt::format("it was run with {} threads", counted.dump());
  else if (!wall.is_object() || !wall.value("solve", Json()).is_number() ||
           !wall.value("setup", Json()).is_number())
    earlier.changed = "its summary.json is not whole";
  else if (!earlier.summary.contains("identity"))
    earlier.changed = "it does not say what it depended on";
  else
    earlier.changed = changes(read_identity(nlohmann::json(earlier.summary["identity"])), identity);
  if (earlier.changed.empty()) earlier.changed = changed_table(folder, scene);
  if (!earlier.changed.empty()) earlier.summary = nullptr;
  return earlier;
}

/// Returns a count from a summary; 0 if it has none.
std::uint64_t count_in(const Json& summary, const char* key) {
  const Json count = summary.value(key, Json());
  return count.is_number_unsigned() ? count.get<std::uint64_t>() : 0;
}

class StudyRuns {
 public:
  StudyRuns(const Study& study, const std::vector<Point>& points, const StudyRunOptions& options,
            Host& host)
      : study_(study), points_(points), options_(options), host_(host) {}

  void check() {
    check_folder();
    RunFaults faults;
    for (const Point& point : points_) {
      Row& row = result_.rows.emplace_back();
      row.choice = point.choice;
      row.run = point.name;
      std::optional<RunProperties> properties;
      try {
        auto scene = read(point);
        row.numbers = numbers(point, *scene);
        properties = properties_of(point, std::move(scene));
      } catch (const InputError& error) {
        faults.add(error, row.run, "scene ");
      }
      try {
        if (!row.numbers.empty()) check_truth(study_, row, properties ? &*properties : nullptr);
      } catch (const InputError& error) {
        faults.add(error, row.run, "");
      }
      try {
        if (properties) check_columns(study_, properties->tables);
      } catch (const InputError& error) {
        faults.add(error, row.run, "");
      }
    }
    faults.throw_if_any(points_.size());
    check_sizes();
  }

  void run_all() {
    fs::create_directories(options_.directory);
    result_.lock = FolderLock(options_.directory);
    fs::create_directories(options_.directory / "runs");
    const std::size_t total = points_.size() * static_cast<std::size_t>(study_.repeats);
    std::size_t number = 0;
    for (std::int64_t repeat = 1; repeat <= study_.repeats; ++repeat)
      for (std::size_t n = 0; n < points_.size(); ++n) {
        ++number;
        Row& row = result_.rows[n];
        if (row.status == "failed") continue;
        if (stop_requested()) {
          forget_stop();
          result_.interrupted = true;
          return;
        }
        run_one(points_[n], row, repeat, fmt::format("[{}/{}] {}", number, total, row.run));
        if (result_.interrupted) return;
      }
  }

  StudyResult result() && { return std::move(result_); }

 private:
  /// Throws InputError if the results of the study would replace foreign files.
  void check_folder() const {
    const fs::path& folder = options_.directory;
    Faults faults;
    if (const std::string run = run_in(folder); !run.empty())
      faults.add("--out", folder.string(), fmt::format("another folder than a run's; {}", run));
    std::vector<fs::path> inputs{study_.file, study_.scene_file};
    for (const Truth& truth : study_.truths) inputs.push_back(truth.file);
    std::error_code error;
    for (const char* name : {"study.json", "study.csv", "study.svg"}) {
      const fs::path file = folder / name;
      const fs::file_status status = fs::symlink_status(file, error);
      if (!fs::exists(status)) continue;
      if (!fs::is_regular_file(status))
        faults.add("--out", file.string(), "a regular file, or nothing, of that name");
      else if (std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
                 return fs::equivalent(file, input, error);
               }))
        faults.add("--out", file.string(),
                   "a folder in which the study replaces nothing that it needs; it reads this "
                   "file, or it is the study");
      else if (file.filename() == "study.json" && !has_study(folder))
        faults.add("--out", file.string(),
                   "the results of a study, or nothing, of that name; another file is there");
    }
    if (const fs::file_status runs = fs::status(folder / "runs", error);
        fs::exists(runs) && !fs::is_directory(runs))
      faults.add("--out", (folder / "runs").string(), "a folder, or nothing, of that name");
    faults.throw_if_any();
  }

  Threads threads(const Point& point) const {
    return point.threads ? Threads(*point.threads) : options_.threads;
  }
  std::unique_ptr<Scene> read(const Point& point) const {
    return read_scene_document({point.scene, study_.scene.origins, study_.scene.variables},
                               study_.scene_file, host_);
  }

  /// Returns the properties of the finished or planned run; nothing if it is too large for this
  /// machine: it becomes a failed row later, and the other runs go on.
  std::optional<RunProperties> properties_of(const Point& point,
                                             std::unique_ptr<Scene> scene) const {
    const fs::path folder = run_directory(options_.directory, point.name, 1);
    if (!options_.fresh)
      if (const Json summary =
              find_earlier(folder, *scene, identity_of(*scene), threads(point)).summary;
          !summary.is_null())
        if (auto tables = tables_in(folder, *scene)) {
          const Json end_time = summary.value("end_time", Json());
          return RunProperties{std::move(*tables),
                               end_time.is_number() ? end_time.get<double>() : infinity, 0};
        }
    forget_lack_of_memory();
    try {
      const auto plan = make_plan(std::move(scene), threads(point));
      plan->tables.push_back({"", history_columns(*plan->model)});
      return RunProperties{std::move(plan->tables), plan->end_time(),
                           plan->stages.empty() ? 0 : plan->stages.back().plan.time_step};
    } catch (const OutsideError&) {
      return std::nullopt;
    } catch (const std::bad_alloc&) {
      return std::nullopt;
    }
  }

  /// Returns the value of each axis in the resolved scene, in SI.
  std::vector<std::optional<double>> numbers(const Point& point, const Scene& scene) const {
    const Json resolved = Json::parse(scene.resolved);
    std::vector<std::optional<double>> found;
    for (const Axis& axis : study_.axes) {
      auto& number = found.emplace_back();
      if (axis.is_threads()) {
        number = threads(point).most();
        continue;
      }
      if (const auto variable = scene.variables.find(variable_at(axis.pointers.front()));
          variable != scene.variables.end()) {
        number = variable->second;
        continue;
      }
      const Json::json_pointer place(axis.pointers.front());
      if (resolved.contains(place) && resolved[place].is_number())
        number = resolved[place].get<double>();
    }
    return found;
  }

  void check_sizes() const {
    if (!study_.refinement) return;
    const Axis& axis = study_.axes[*study_.refinement];
    Faults faults;
    for (const Row& row : result_.rows)
      if (const auto& size = row.numbers[*study_.refinement];
          faults.empty() && !(size && *size > 0))
        faults.add(member("/vary", axis.name), axis.labels[row.choice[*study_.refinement]],
                   fmt::format("sizes above 0 in the first of its pointers, because \"{}\" is the "
                               "axis that refines",
                               axis.name));
    faults.throw_if_any();
  }

  void run_one(const Point& point, Row& row, std::int64_t repeat, const std::string& title) {
    RunOptions run_options{run_directory(options_.directory, row.run, repeat), true};
    run_options.overwrite = true;  // the folder belongs to the study
    auto scene = read(point);
    Identity identity = identity_of(*scene);
    auto [summary, changed] =
        options_.fresh ? EarlierRun()
                       : find_earlier(run_options.directory, *scene, identity, threads(point));
    const bool there = !summary.is_null();
    if (!changed.empty()) spdlog::info("{}: runs again: {}", title, changed);
    row.identity = identity_hash(identity);
    if (!there) {
      int code = exit_outside;
      std::string reason;
      {
        const QuietLog quiet;
        forget_lack_of_memory();
        try {
          const auto plan = make_plan(std::move(scene), threads(point));
          code = run(*plan, run_options);
        } catch (const std::bad_alloc&) {
          reason = "not enough memory";
        } catch (const InputError& error) {  // a foreign file in its folder
          reason = error.what();
        } catch (const OutsideError& error) {
          reason = error.what();
        }
      }
      if (code == exit_interrupted) {
        result_.interrupted = true;
        return spdlog::warn("{}: interrupted", title);
      }
      summary = summary_in(run_options.directory);
      if (summary.is_discarded()) summary = nullptr;
      if (code != exit_done || summary.is_null()) {
        if (reason.empty())
          reason = summary.is_null() ? "summary.json cannot be read" : word_in(summary, "reason");
        row.fail(reason, code == exit_done ? exit_outside : code);
        return spdlog::error("{}: failed: {}", title, row.reason);
      }
    }
    take(row, summary, repeat);
    if (there)
      spdlog::info("{}: there already", title);
    else
      spdlog::info("{}: {:.3g} s, {} particles, {} steps", title, row.solve_seconds.back(),
                   row.particles, row.steps);
  }

  static void take(Row& row, const Json& summary, std::int64_t repeat) {
    row.status = "done";
    row.particles = count_in(summary, "particles");
    row.steps = count_in(summary, "steps");
    const Json& wall = summary.at("wall_seconds");
    row.solve_seconds.push_back(wall.at("solve").get<double>());
    if (repeat == 1) row.setup_seconds = wall.at("setup").get<double>();
  }

  const Study& study_;
  const std::vector<Point>& points_;
  const StudyRunOptions& options_;
  Host& host_;
  StudyResult result_;
};

}  // namespace

fs::path run_directory(const fs::path& directory, const std::string& run, std::int64_t repeat) {
  const fs::path folder = directory / "runs" / run;
  return repeat == 1 ? folder : folder / fmt::format("repeat_{}", repeat);
}

StudyResult run_study(const Study& study, const std::vector<Point>& points,
                      const StudyRunOptions& options, Host& host) {
  StudyRuns runs(study, points, options, host);
  runs.check();
  runs.run_all();
  return std::move(runs).result();
}

}  // namespace hyperlattice::study
