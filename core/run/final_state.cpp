#include <base/content_hash.hpp>
#include <base/errors.hpp>
#include <base/folder_file.hpp>
#include <plan/file_names.hpp>
#include <run/final_state.hpp>
#include <run/measured.hpp>
#include <run/records.hpp>
#include <state/archive.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view about_tag = "head", body_tag = "stat";
constexpr int state_version = 1;  // of the format of the file

/// What loads did at the end of a run.
struct LoadsAtEnd {
  /// Numbers that each load keeps, by the hash of its stage in the scene.
  std::map<std::string, std::vector<double>> memory;
  std::vector<Particle> particles;  ///< on which forces act, ascending
  std::vector<Vec3> forces;         ///< N, the mean over half a step before the end
};

void archive(Archive& archive, LoadsAtEnd& loads) {
  std::uint64_t count = loads.memory.size();
  archive(count);
  auto known = loads.memory.begin();
  for (std::uint64_t n = 0; n < count; ++n) {
    std::vector<char> name;
    std::vector<double> numbers;
    if (!archive.restores()) {
      name.assign(known->first.begin(), known->first.end());
      numbers = known++->second;
    }
    archive(name);
    archive(numbers);
    if (archive.restores()) loads.memory[{name.begin(), name.end()}] = std::move(numbers);
  }
  archive(loads.particles);
  archive(loads.forces);
}

/// Returns the hash of a load's stage in the scene, for each load.
std::vector<std::string> hashes_of_loads(const Model& model) {
  const auto scene = nlohmann::json::parse(model.scene->resolved);
  std::vector<std::string> hashes;
  for (const Load& load : model.loads)
    hashes.push_back(
        hash_of_text(scene.at(nlohmann::json::json_pointer(load.stage->pointer)).dump()));
  return hashes;
}

LoadsAtEnd loads_at_end(const Model& model, Simulation& simulation) {
  LoadsAtEnd loads;
  const std::vector<std::string> hashes = hashes_of_loads(model);
  for (std::size_t n = 0; n < hashes.size(); ++n)
    if (const auto numbers = simulation.load_memory(n); !numbers.empty())
      loads.memory[hashes[n]].assign(numbers.begin(), numbers.end());
  if (simulation.last_step() == 0) return loads;  // velocities are those at the end
  const std::vector<Vec3> forces = Measured(model, simulation).external_forces();
  for (Particle p = 0; p < forces.size(); ++p)
    if (!(forces[p] == Vec3{})) {
      loads.particles.push_back(p);
      loads.forces.push_back(forces[p]);
    }
  return loads;
}

/// Returns the axes along which loads prescribe the motion of particles.
std::map<Particle, Axes> prescribed_axes(const Model& model) {
  std::map<Particle, Axes> axes;
  for (const Load& load : model.loads)
    for (const LoadedParticle& loaded : load.particles)
      if ((loaded.displaced | loaded.driven) != 0)
        axes[loaded.particle] |= loaded.displaced | loaded.driven;
  return axes;
}

/// The first step kicks the velocities over the half step before the state too, with the loads of
/// the new run. Adds the impulse of the old loads over this time in place of that of the new ones.
/// Equal loads add nothing, to the last bit.
void exchange_impulses(const LoadsAtEnd& before, const Model& model, Simulation& simulation) {
  if (simulation.last_step() == 0) return;
  std::vector<Vec3> change = Measured(model, simulation).external_forces();
  for (Vec3& force : change) force = -1 * force;
  for (std::size_t n = 0; n < before.particles.size(); ++n)
    change.at(before.particles[n]) += before.forces[n];
  for (const auto& [particle, axes] : prescribed_axes(model))
    for (int c = 0; c < 3; ++c)
      if ((axes >> c & 1U) != 0) change[particle][c] = 0;
  if (std::all_of(change.begin(), change.end(), [](Vec3 force) { return force == Vec3{}; })) return;
  std::vector<double> velocities, height_rates;
  simulation.velocities(velocities);
  simulation.height_rates(height_rates);
  for (Particle p = 0; p < change.size(); ++p)
    for (int c = 0; c < 3; ++c)
      velocities[3 * p + static_cast<std::size_t>(c)] +=
          simulation.last_step() / 2 * change[p][c] / simulation.inertia(p);
  simulation.set_velocities(velocities, height_rates);
}

/// Reads the head of a state file that is open.
StartState read_about(RecordReader& records, const fs::path& file) {
  try {
    const auto json = nlohmann::json::parse(records.take_all(about_tag));
    if (json.at("version") != state_version)
      throw std::runtime_error(file.string() + ": a state of another version of the program");
    StartState start;
    start.file = file;
    start.blocks = json.at("blocks").get<std::int32_t>();
    start.steps = json.at("step").get<std::uint64_t>();
    start.time = json.at("time").get<double>();
    start.body = read_body_facts(json.at("body"));
    return start;
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error(file.string() + ": no state of a run");
  }
}

}  // namespace

void write_final_state(const Plan& plan, Simulation& simulation, RunFolder& folder, Ranks& ranks) {
  simulation.gather_in_first();
  if (!ranks.is_first()) return;
  const Ranks::Solo solo(ranks);
  LoadsAtEnd loads = loads_at_end(*plan.model, simulation);
  folder.claim(state_file, false);
  AtomicFile file((folder.directory() / state_file).string());
  RecordWriter records(file);
  const nlohmann::json head{{"version", state_version},
                            {"blocks", plan.blocks},
                            {"step", simulation.steps()},
                            {"time", simulation.time()},
                            {"body", body_facts_json(body_facts(*plan.model))}};
  const std::string text = head.dump();
  records.put(about_tag, text.data(), text.size());
  Archive state([&](void* data, std::size_t size) { records.put(body_tag, data, size); }, false);
  archive(state, loads);
  simulation.archive_body(state);
  records.end();
  file.commit();
}

StartState read_start(const fs::path& directory) {
  const fs::path file = directory / state_file;
  if (!is_there(file))
    throw InputError({{"--from", file.string(),
                       "the final state of a run that was started with --keep-state and is done; "
                       "there is none"}});
  try {
    RecordReader::verify(file);
    RecordReader records(file);
    StartState start = read_about(records, file);
    start.hash = hash_of_file(file);
    return start;
  } catch (const std::runtime_error& error) {
    throw InputError(
        {{"--from", file.string(), std::string("a state that is whole; ") + error.what()}});
  }
}

void start_from(const StartState& start, const Model& model, Simulation& simulation, Ranks& ranks) {
  const Ranks::Solo solo(ranks);  // each rank reads the whole state
  RecordReader records(start.file);
  read_about(records, start.file);
  Archive state([&](void* data, std::size_t size) { records.take(body_tag, data, size); }, true);
  LoadsAtEnd loads;
  archive(state, loads);
  simulation.archive_body(state);
  const std::vector<std::string> hashes = hashes_of_loads(model);
  for (std::size_t n = 0; n < hashes.size(); ++n) {
    const auto kept = loads.memory.find(hashes[n]);
    const std::span<double> numbers = simulation.load_memory(n);
    if (kept != loads.memory.end() && kept->second.size() == numbers.size())
      std::copy(kept->second.begin(), kept->second.end(), numbers.begin());
  }
  exchange_impulses(loads, model, simulation);
}

bool is_done(const fs::path& directory) {
  const auto file = read_folder_file(directory, "summary.json", largest_json);
  const auto summary = nlohmann::json::parse(file ? file->text : "", nullptr, false);
  return summary.is_object() && summary.contains("status") && summary["status"] == "done";
}

std::string about_done_run(const fs::path& directory) {
  if (!is_done(directory)) return {};
  return is_there(directory / state_file)
             ? fmt::format(
                   ". The run is done: a scene with a later end goes on from its end by "
                   "--from {} into another folder",
                   directory.string())
             : ". The run is done, and it kept no state: run it with --keep-state, and a scene "
               "with a later end can go on from its end by --from";
}

}  // namespace hyperlattice
