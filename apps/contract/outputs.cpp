// The contract of writers and probes: they leave whole files and no others, write valid numbers,
// and report a full disk without leaving half of a file.
#include <base/csv.hpp>
#include <contract/families.hpp>
#include <contract/small_disk.hpp>
#include <run/outputs.hpp>

#include <spdlog/fmt/fmt.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

namespace hyperlattice::contract {
namespace {

namespace fs = std::filesystem;

/// A temporary folder; its destructor deletes it.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ =
        fs::temp_directory_path() / fmt::format("hyperlattice_contract_{}_{}", ::getpid(), count++);
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    try {
      fs::remove_all(path_);
    } catch (...) {  // files that stay are in the system's folder for temporary ones
    }
  }
  const fs::path& path() const { return path_; }

  /// Returns the content of every file, by its path relative to the folder.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_)) {
      if (!entry.is_regular_file() || entry.path().filename() == own_files_list) continue;
      std::ostringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      all[fs::relative(entry.path(), path_).string()] = text.str();
    }
    return all;
  }

 private:
  fs::path path_;
};

/// A small block in motion, whose springs may break, and the output under test.
class MovingBlock {
 public:
  MovingBlock(const Plan& plan, const Folder& folder)
      : plan_(plan),
        folder_(folder),
        model_(*plan.model),
        simulation_(std::make_unique<Simulation>(model_, plan.threads)) {
    const std::size_t particles = model_.body.particles;
    simulation_->set_velocities(noise(3 * particles, 1), std::vector<double>(particles, 0.0));
    run_folder_ = std::make_unique<RunFolder>(folder.path(), true);
    run_folder_->begin(false, {});
    outputs_ = std::make_unique<Outputs>(plan_, *simulation_, *run_folder_, alone_);
    outputs_->begin();
  }
  void show() { outputs_->show_now(); }
  void move() { simulation_->step(0.5 * model_.step_limit.time_step); }
  void end() { outputs_->end(); }

  /// Imitates the end of the program and a resumed run.
  void restart() {
    outputs_->drain();
    const std::string shown = saved([&](Archive& archive) { outputs_->archive(archive); });
    const auto marks = run_folder_->sync();
    outputs_.reset();
    run_folder_.reset();
    run_folder_ = std::make_unique<RunFolder>(folder_.path(), false);
    run_folder_->go_on(marks);
    simulation_ = restarted(*simulation_, model_, plan_.threads);
    outputs_ = std::make_unique<Outputs>(plan_, *simulation_, *run_folder_, alone_);
    restore(shown, [&](Archive& archive) { outputs_->archive(archive); });
    outputs_->begin();
  }

 private:
  Ranks alone_;
  const Plan& plan_;
  const Folder& folder_;
  const Model& model_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<RunFolder> run_folder_;
  std::unique_ptr<Outputs> outputs_;
};

std::unique_ptr<Plan> plan_with(const Trial& trial, int threads = 1) {
  return trial.scenes.plan_of(
      {trial.scenes.grid_box(6, 5, 4), trial.scenes.brittle(usual_membrane, 1e-7), trial.example},
      threads);
}

/// Returns the files after three frames.
std::map<std::string, std::string> written(const Plan& plan, bool cut_off = false,
                                           std::string* unannounced = nullptr) {
  const Folder folder;
  MovingBlock watched(plan, folder);
  for (int n = 0; n < 3; ++n) {
    if (n > 0) watched.move();
    watched.show();
    if (n == 1 && cut_off) watched.restart();
  }
  watched.end();
  auto files = folder.files();
  const auto own = read_own_files(folder.path());
  for (const auto& [name, bytes] : files)
    if (unannounced != nullptr && own->find(name) == own->end()) *unannounced = name;
  return files;
}

std::string partial(const std::map<std::string, std::string>& files) {
  for (const auto& [name, bytes] : files)
    if (bytes.empty() || name.ends_with(".part")) return name;
  return "";
}

Finding finishes_files(const Plan& plan) {
  std::string unannounced;
  const auto files = written(plan, false, &unannounced);
  if (!unannounced.empty())
    return passes_if(false, unannounced + " was not announced to the context");
  std::size_t bytes = 0;
  for (const auto& [name, content] : files) bytes += content.size();
  if (const std::string name = partial(files); !name.empty())
    return passes_if(false, name + " is empty, or was not finished");
  return passes_if(!files.empty(),
                   fmt::format("three frames leave {} files, {} bytes", files.size(), bytes));
}

/// Returns the name of the first file that differs or that only one side has; empty if there is
/// none.
std::string difference(const std::map<std::string, std::string>& a,
                       const std::map<std::string, std::string>& b) {
  for (const auto& [name, bytes] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != bytes) return name;
  for (const auto& [name, bytes] : b)
    if (a.count(name) == 0) return name;
  return "";
}

/// Writes one frame, a second one on a full disk, and a third one when there is room again.
Finding full_disk(const Plan& plan) {
  constexpr rlim_t nothing = 16;
  const Folder folder;
  MovingBlock watched(plan, folder);
  watched.show();
  const auto before = folder.files();
  watched.move();
  std::cout.flush();  // standard output may be a file
  std::string sentence;
  {
    const SmallDisk disk(nothing);
    try {
      watched.show();
      watched.end();
    } catch (const std::exception& error) {
      sentence = error.what();
    }
  }
  if (sentence.empty()) return passes_if(false, "a frame that cannot be written is no error");
  if (const std::string name = difference(before, folder.files()); !name.empty())
    return passes_if(false, fmt::format("it complains (\"{}\"), but {} is not as it was before",
                                        sentence, name));
  watched.move();
  watched.show();
  return passes_if(
      folder.files().size() >= before.size(),
      "it says \"" + sentence + "\", leaves no half-written file, and goes on when there is room");
}

Finding table(const Plan& plan) {
  const auto files = written(plan);
  if (files.size() != 1) return passes_if(false, fmt::format("{} tables", files.size()));
  const CsvTable table = parse_csv(files.begin()->second);
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (!csv_number(row[c]))
        return passes_if(
            false, fmt::format("'{}' in the column {} is no number", row[c], table.columns[c]));
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    if (std::find(table.columns.begin(), table.columns.end(), table.columns[c]) !=
        table.columns.begin() + static_cast<std::ptrdiff_t>(c))
      return passes_if(false, "two columns are called " + table.columns[c]);
  return passes_if(table.columns.size() > 1 && !table.rows.empty(),
                   fmt::format("three samples: {} numbers in {} columns read back",
                               table.rows.size() * table.columns.size(), table.columns.size()));
}

Finding same_bytes(const Plan& one, const Plan& three) {
  const std::string name = difference(written(one), written(three));
  return passes_if(name.empty(),
                   name.empty() ? "with 1 and 3 threads" : name + " differs with 1 and 3 threads");
}

Finding restart(const Plan& plan) {
  const std::string name = difference(written(plan), written(plan, true));
  return passes_if(name.empty(),
                   name.empty() ? "the same files when it is cut off after two frames and goes on"
                                : name +
                                      " is another when it is cut off after two frames and goes "
                                      "on, see OutputContext::earlier");
}

}  // namespace

void check_writer(Trial& trial) {
  const auto plan = plan_with(trial), with_three = plan_with(trial, 3);
  trial.check("finishes its files", [&] { return finishes_files(*plan); });
  trial.check("full disk", [&] { return full_disk(*plan); });
  trial.check("same bytes", [&] { return same_bytes(*plan, *with_three); });
  trial.check("restart", [&] { return restart(*plan); });
}

void check_probe(Trial& trial) {
  const auto plan = plan_with(trial), with_three = plan_with(trial, 3);
  trial.check("table reads back", [&] { return table(*plan); });
  trial.check("same bytes", [&] { return same_bytes(*plan, *with_three); });
  trial.check("restart", [&] { return restart(*plan); });
}

}  // namespace hyperlattice::contract
