#include <model/nodal_volumes.hpp>
#include <plan/estimates.hpp>
#include <plan/fields.hpp>
#include <state/block.hpp>
#include <state/damage_records.hpp>
#include <state/halo.hpp>
#include <state/inside_out.hpp>
#include <state/layout.hpp>
#include <state/nodal_pressures.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <set>

namespace hyperlattice {

namespace {

/// Returns how many numbers per particle these fields have.
double numbers_of(const Plan& plan, const auto& fields) {
  double numbers = 0;
  for (const std::string_view name : fields) numbers += components_of(*field_of(*plan.model, name));
  return numbers;
}

/// Returns how many numbers per particle the fields of an output have.
double numbers_per_particle(const Plan& plan, const Stage& output) {
  return numbers_of(plan, plan.asked_fields.at(&output));
}

/// Returns how many more numbers per particle are in memory while these fields are computed: the
/// displacements, the tensors and weights of the field that is being computed, and the quantities
/// from which several fields follow (class Measured).
double working_numbers(const std::set<std::string>& fields) {
  if (!std::any_of(fields.begin(), fields.end(), is_measured)) return 0;
  const auto asks = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return fields.count(name) > 0; });
  };
  const bool principal = asks({"principal_stress", "principal_direction_1", "principal_direction_2",
                               "principal_direction_3"});
  double numbers = 4 + 2 * 9 + 1;
  if (principal) numbers += 12;
  if (principal || asks({"stress", "von_mises", "pressure"})) numbers += 6;
  if (asks({"strain", "hencky_strain", "strain_rate"})) numbers += 9;
  if (asks({"internal_force", "external_force", "force", "acceleration"})) numbers += 6;
  return numbers;
}

/// Returns the fields of the frames that are written beside the steps.
std::set<std::string> queued_fields(const Plan& plan) {
  std::set<std::string> fields;
  for (const auto& [writer, used] : plan.used_fields) fields.insert(used.begin(), used.end());
  return fields;
}

/// Returns the numbers per particle of all outputs: the positions, the fields of the present state,
/// which the run keeps for the next one, the copies of frames that wait, and what is computed on
/// the way.
double output_numbers(const Plan& plan) {
  std::set<std::string> asked, kept;
  for (const auto& [output, fields] : plan.asked_fields) {
    asked.insert(fields.begin(), fields.end());
    // Frames that are written beside the steps take their fields along.
    const auto used = plan.used_fields.find(output);
    if (plan.threads == 1 || used == plan.used_fields.end() || used->second.empty())
      kept.insert(fields.begin(), fields.end());
  }
  if (plan.asked_fields.empty() || !plan.writes) return 0;
  double numbers = 3 + numbers_of(plan, kept) + working_numbers(asked);
  if (plan.threads > 1) numbers += queued_frames * numbers_of(plan, queued_fields(plan));
  return numbers;
}

/// The memory of the program and its libraries without a body, bytes.
constexpr double program_bytes = 14e6;
/// The same of an engine and its libraries.
constexpr double engine_bytes = 10e6;

double particles_of(const Plan& plan) { return static_cast<double>(plan.model->body.particles); }

}  // namespace

double allocated_bytes(const Model& model) { return program_bytes + model_bytes(model); }

double frames_of(const Plan& plan, const Stage& output) {
  const double duration = plan.end_time() - plan.start_time(),
               every = output_interval(output, duration),
               intervals = every > 0 ? duration / every : 0;
  constexpr double nearly = 1e-6;  // of an interval
  double frames = std::floor(intervals + nearly) + (output.cadence.first ? 1 : 0);
  // Each state of rest is shown, whatever its time.
  for (const PlannedStage& stage : plan.stages)
    if (stage.plan.at_rest && &stage != &plan.stages.back()) ++frames;
  const bool ends_between = intervals == 0 || intervals - std::floor(intervals + nearly) > nearly;
  const bool shows_end =
      output.cadence.last || (!plan.stages.empty() && plan.stages.back().plan.at_rest);
  if (ends_between && shows_end) ++frames;
  return std::min(frames, static_cast<double>(plan.steps()) + 1);
}

double frame_bytes(const Plan& plan, const Stage& writer) {
  constexpr double bytes_per_number = 12;  // binary has 8, text 20
  if (const auto cost = plan.frame_costs.find(&writer); cost != plan.frame_costs.end())
    return cost->second.bytes;
  return particles_of(plan) * (3 + numbers_per_particle(plan, writer)) * bytes_per_number;
}

double records_of(const PlannedStage& stage) {
  if (stage.plan.at_rest) {
    const std::uint64_t whole = stage.plan.steps / record_steps(stage);
    return static_cast<double>(whole) + 1;
  }
  return std::min((stage.plan.end_time - stage.start_time) / record_interval(stage),
                  static_cast<double>(stage.plan.steps)) +
         1;
}

double model_bytes(const Model& model) {
  const std::size_t runs = model.body.runs.size() + model.body.cells.runs().size();
  auto bytes =
      static_cast<double>((model.body.listed.springs.size() + model.body.listed.cut.size()) *
                              sizeof(ListedSpring) +
                          model.body.cut_sites.size() * sizeof(CutSite) +
                          model.body.listed.positions.size() * sizeof(Vec3) + runs * sizeof(Run) +
                          model.body.row_runs.size() * sizeof(std::size_t) +
                          model.body.cells.partial().size() * sizeof(PartialCell) +
                          model.loads.start_velocities.size() * sizeof(StartVelocity)) +
      model.kinds.material_of.bytes() + model.kinds.mixtures.bytes();
  if (model.nodal_volumes)
    bytes += model.nodal_volumes->bytes() + NodalPressures::bytes(*model.nodal_volumes);
  if (!model.cohesive.empty())
    bytes += static_cast<double>(model.body.particles * DamageRecords::bytes_of_particle);
  for (const Load& load : model.loads)
    bytes += static_cast<double>(load.particles.size() * sizeof(LoadedParticle) +
                                 load.watched.size() * sizeof(WatchedParticle));
  return bytes;
}

namespace {

/// Returns the bytes of what the ranks share: the blocks with their scratch.
double block_bytes(const Layout& layout) { return layout.state_bytes() + layout.scratch_bytes(); }

/// Returns the largest part of the places of all blocks that a rank has.
double largest_part(const Plan& plan, const Layout& layout) {
  const std::vector<int> owners = owners_of(layout.blocks.size(), plan.ranks);
  std::vector<double> sites(static_cast<std::size_t>(plan.ranks));
  for (std::size_t b = 0; b < owners.size(); ++b)
    sites[static_cast<std::size_t>(owners[b])] += static_cast<double>(layout.blocks[b].sites);
  return *std::max_element(sites.begin(), sites.end()) /
         std::accumulate(sites.begin(), sites.end(), 0.0);
}

}  // namespace

std::string whole_after_steps(const Plan& plan) {
  for (const PlannedStage& stage : plan.stages)
    if (stage.plan.local.parts > 1) return fmt::format("{} has local steps", stage.stage->name);
  return needs_whole(*plan.model);
}

std::string whole_in_ranks(const Plan& plan) {
  for (const PlannedStage& stage : plan.stages)
    if (stage.plan.at_rest || stage.plan.bytes_per_site > 0)
      return fmt::format("{} works on the whole body", stage.stage->name);
  return whole_after_steps(plan);
}

std::string first_needs_whole(const Plan& plan) {
  for (const auto& [output, needs] : plan.needs)
    if (needs.state)
      return fmt::format("{} asks for more than the motion of particles", output->name);
  return "";
}

double rank_bytes(const Plan& plan, const Layout& layout, double part, bool writes) {
  const Model& model = *plan.model;
  const double particles = particles_of(plan);
  double bytes = model_bytes(model);
  constexpr std::size_t boundary_particle =
      sizeof(BoundaryParticle) + sizeof(Contribution) + sizeof(Vec3);
  for (const Load& load : model.loads)
    bytes += static_cast<double>(load.particles.size() * boundary_particle +
                                 load.watched.size() * (boundary_particle + 2 * sizeof(Vec3)) +
                                 load.memory * sizeof(double));
  for (const BlockLayout& block : layout.blocks)
    bytes += static_cast<double>(block.rows.size() *
                                 (2 * sizeof(Row) + sizeof(RowSums) + sizeof(double)));

  double added_bytes = 0;  // of added mass: lists, and a boundary particle each
  for (const PlannedStage& stage : plan.stages)
    if (stage.mass_scaling)
      added_bytes = std::max(
          added_bytes,
          static_cast<double>(stage.mass_scaling->particles().size() *
                              (sizeof(BoundaryParticle) + 4 * sizeof(MassScaling::Heavy))));
  bytes += added_bytes;

  double solver_bytes = 0;
  for (const PlannedStage& stage : plan.stages)
    solver_bytes = std::max(solver_bytes, stage.plan.bytes_per_site);
  const Site low = model.body.low, high = model.body.high;
  solver_bytes *= model.body.is_listed()
                      ? particles
                      : (high.i - low.i + 1.0) * (high.j - low.j + 1.0) * (high.k - low.k + 1.0);
  bytes += program_bytes + solver_bytes + CellWatch::bytes(model);
  if (plan.ranks > 1) bytes += engine_bytes;
  bool is_whole = !whole_in_ranks(plan).empty();
  if (writes) {
    // Writers write one after the other, but may keep what they have allocated.
    for (const auto& [writer, allocated] : plan.writer_bytes) bytes += allocated;
    bytes += output_numbers(plan) * sizeof(double) * particles;
    is_whole = is_whole || !first_needs_whole(plan).empty();
  }
  return bytes + block_bytes(layout) * (is_whole ? 1 : part);
}

void estimate_memory(Plan& plan) {
  const std::unique_ptr<Layout> layout = make_layout(*plan.model, plan.blocks);
  plan.bytes_per_particle = layout->state_bytes() / particles_of(plan);
  plan.memory_bytes = rank_bytes(plan, *layout, largest_part(plan, *layout), plan.writes);
}

void estimate_output(Plan& plan) {
  constexpr double bytes_per_text_number = 19;
  const double history_numbers = 16 + static_cast<double>(plan.model->loads.size());
  constexpr double fraction_at_rest = 0.3;  // of the bytes of a frame in motion
  constexpr double own_files = 12e3,
                   listed_file =
                       90;  // bytes: scene.resolved.json and summary.json; a line of files.csv
  plan.output_bytes = own_files;
  for (const Stage* stage : plan.scene->of(Family::writers)) {
    const double frames = frames_of(plan, *stage),
                 saved = stage->cadence.first ? 1 - fraction_at_rest : 0;
    plan.output_bytes += (frames - saved) * frame_bytes(plan, *stage) + frames * listed_file;
  }
  const auto probes = plan.scene->of(Family::probes);
  for (std::size_t n = 0; n < probes.size() && n < plan.tables.size(); ++n)
    plan.output_bytes += (1 + frames_of(plan, *probes[n])) *
                         static_cast<double>(plan.tables[n].columns.size()) * bytes_per_text_number;
  for (const PlannedStage& stage : plan.stages)
    plan.output_bytes += records_of(stage) * history_numbers * bytes_per_text_number;
}

double output_seconds(const Plan& plan, double sweep, bool measured) {
  constexpr double write = 5e-9;  // s per number of a frame
  double seconds = 0;
  for (const Stage* stage : plan.scene->of(Family::writers)) {
    const auto cost = plan.frame_costs.find(stage);
    const auto used = plan.used_fields.find(stage);
    const bool known = measured && cost != plan.frame_costs.end(),
               queued = used != plan.used_fields.end() && !used->second.empty();
    // The thread of a queued frame takes time from those of the steps.
    seconds += frames_of(plan, *stage) / (queued ? plan.threads : 1) *
               (known ? cost->second.seconds
                      : particles_of(plan) * (3 + numbers_per_particle(plan, *stage)) * write);
  }
  for (const PlannedStage& stage : plan.stages) seconds += sweep * records_of(stage);
  return seconds;
}

double slowest(const Model& model) {
  // Measured on a sphere that a blast breaks and whose pieces collide.
  constexpr double breaking = 3, answering = 5;
  return (model.springs.breakable ? breaking : 1) * (model.loads.answering ? answering : 1);
}

void estimate_time(Plan& plan) {
  constexpr double baseline = 4, avx2 = 1.4, avx512 = 0.9;  // ns per base spring and step
  constexpr double fourth_dimension = 1.8, damped = 1.1, floats = 0.6, listed = 4,
                   second_thread = 0.6;
  // Instructions of a step with the volumetric energy of cells over those without it.
  constexpr double volumetric = 1.59, volumetric_floats = 1.51;
  const Model& model = *plan.model;
  const std::string_view instructions = model.springs.kernels().instructions;
  plan.expected_seconds = 0;
  double spring = instructions == "avx512" ? avx512 : instructions == "avx2" ? avx2 : baseline;
  if (model.degrees_of_freedom == 4) spring *= fourth_dimension;
  if (model.body.is_listed()) spring *= listed;
  const bool single = model.springs.choice.precision == Precision::floats;
  if (single) spring *= floats;
  if (!model.volumetric.empty()) spring *= single ? volumetric_floats : volumetric;
  const double step = 1e-9 * spring * static_cast<double>(model.body.base_springs()) /
                      (1 + second_thread * (plan.threads - 1)) /
                      (needs_whole(model).empty() ? plan.ranks : 1);
  for (const PlannedStage& stage : plan.stages)
    plan.expected_seconds += step * static_cast<double>(stage.plan.steps) *
                             stage.plan.sweeps_per_step * (stage.plan.damping > 0 ? damped : 1);
  plan.expected_seconds += output_seconds(plan, step, false);
}

}  // namespace hyperlattice
