#include <contract/scenes.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyperlattice::contract {

namespace {
Json box(Json lattice, int nx, int ny, int nz) {
  constexpr double l = 1e-3;
  lattice["spacing"] = l;
  lattice["shape"]["box"] = {{"low", {0, 0, 0}}, {"high", {nx * l, ny * l, nz * l}}};
  return lattice;
}
}  // namespace

Json Scenes::grid_box(int nx, int ny, int nz, const char* boundary) const {
  return box({{"type", around_.grid}, {"boundary", boundary}}, nx, ny, nz);
}

Json Scenes::listed_box(int nx, int ny, int nz) const {
  return box({{"type", around_.list}}, nx, ny, nz);
}

Json Scenes::material(const char* membrane) const {
  Json material{
      {"type", around_.material}, {"young", 1e10}, {"density", 2500}, {"membrane", membrane}};
  if (std::string_view(membrane) != "none") material["poisson"] = 0.1;
  return material;
}

Json Scenes::brittle(const char* membrane, double limit) const {
  Json brittle = material(membrane);
  brittle["failure"] = {{"type", around_.failure}, {"limit", limit}};
  return brittle;
}

Json Scenes::platen(const char* face, double way) const {
  return {{"type", around_.displacement},
          {"on", face},
          {"value", {0, 0, way}},
          {"axes", "z"},
          {"rise", 1e-5}};
}

std::unique_ptr<Plan> Scenes::plan_of(const std::vector<Json>& stages, int threads,
                                      const char* precision) const {
  Json scene{{"format", "hyperlattice/1"},
             {"title", "contract"},
             {"precision", precision},
             {"pipeline", stages}};
  const auto is_solver = [](const Json& stage) {
    return stage.at("type").get<std::string>().starts_with("solvers.");
  };
  if (std::none_of(stages.begin(), stages.end(), is_solver))
    scene["pipeline"].push_back({{"type", around_.steps}, {"end_time", 1e-3}});
  return make_plan(read_scene_text(scene.dump(), host_), threads);
}

std::vector<double> noise(std::size_t count, double amplitude, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> values(count);
  for (double& value : values)
    value = amplitude * (2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1);
  return values;
}

std::string saved(const std::function<void(Archive&)>& visit) {
  std::string bytes;
  Archive archive(
      [&](void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); },
      false);
  visit(archive);
  return bytes;
}

void restore(const std::string& bytes, const std::function<void(Archive&)>& visit) {
  std::size_t read = 0;
  Archive archive(
      [&](void* data, std::size_t size) {
        read += bytes.copy(static_cast<char*>(data), size, read);
      },
      true);
  visit(archive);
}

std::unique_ptr<Simulation> restarted(Simulation& simulation, const Model& model, int threads) {
  auto other = std::make_unique<Simulation>(model, threads);
  restore(saved([&](Archive& archive) { simulation.archive(archive); }),
          [&](Archive& archive) { other->archive(archive); });
  return other;
}

MotionResult run_motion(const Model& model, const RandomMotion& motion) {
  auto simulation = std::make_unique<Simulation>(model, motion.threads);
  const std::size_t particles = model.body.particles;
  simulation->set_velocities(
      noise(3 * particles, motion.speed),
      std::vector<double>(model.degrees_of_freedom == 4 ? particles : 0, 0.0));
  MotionResult result;
  simulation->balance();
  const int steps = static_cast<int>(std::ceil(motion.duration / motion.step));
  for (int n = 0; n < steps; ++n) {
    if (motion.cut_off && n == steps / 2)
      simulation = restarted(*simulation, model, motion.threads);
    simulation->step(motion.duration / steps * model.step_limit.time_step);
    result.balance = simulation->balance();
    take_largest(result.largest_error, result.balance.relative_error());
  }
  result.hash = simulation->hash();
  return result;
}

std::vector<double> DrivenBody::forces(const std::vector<double>& displacements, double time_step) {
  const bool heights = model_.degrees_of_freedom == 4;
  const std::vector<double> still(displacements.size(), 0.0),
      level(heights ? displacements.size() / 3 : 0, 0.0);
  simulation_.set_displacements(displacements, level);
  simulation_.set_velocities(still, level);
  simulation_.step(time_step);
  std::vector<double> forces;
  simulation_.velocities(forces);  // v = (back + forward) F / m
  for (std::size_t n = 0; n < forces.size(); ++n)
    forces[n] *= model_.mass(n / 3) * 2 / (last_step_ + time_step);
  last_step_ = time_step;
  return forces;
}

void take_largest(double& largest, double value) {
  if (!(std::abs(value) <= largest)) largest = std::isnan(value) ? infinity : std::abs(value);
}

double largest(const std::vector<double>& values) {
  double found = 0;
  for (const double value : values) take_largest(found, value);
  return found;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) differences[n] = a[n] - b[n];
  return largest(differences);
}

}  // namespace hyperlattice::contract
