#include <base/errors.hpp>
#include <model/build.hpp>
#include <plan/body_at_rest.hpp>
#include <plan/columns.hpp>
#include <plan/fields.hpp>
#include <plan/output_trial.hpp>
#include <plan/trial_folder.hpp>
#include <plan/writer_warning.hpp>
#include <process/file_limit.hpp>
#include <process/lack_of_memory.hpp>
#include <scene/stage_call.hpp>

#include <hyperlattice/output.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hyperlattice {
namespace {

/// A few particles, spread over all that a writer shows, in a motion whose numbers have all digits.
class ParticleSample {
 public:
  /// `regions`: those that the writer asks for. It shows the largest of them, or the whole body if
  /// there are none.
  ParticleSample(const Model& model, BodyAtRest& rest, const std::vector<RegionId>& regions,
                 std::size_t most)
      : model_(model), rest_(rest) {
    std::span<const Particle> shown;
    for (const RegionId region : regions)
      if (const auto particles = rest.particles(region); particles.size() > shown.size())
        shown = particles;
    all_ = regions.empty() ? model.body.particles : shown.size();
    const std::size_t size = std::min(most, all_);
    for (std::size_t n = 0; n < size; ++n) {
      const std::size_t place = n * (all_ / size) + n * (all_ % size) / size;
      particles_.push_back(regions.empty() ? static_cast<Particle>(place) : shown[place]);
    }
    for (const Particle particle : particles_) {
      const Vec3 x = model.body.position(particle);
      positions_.insert(positions_.end(), {x.x, x.y, x.z});
    }
  }
  ParticleSample(const ParticleSample&) = delete;
  ParticleSample& operator=(const ParticleSample&) = delete;

  std::size_t size() const { return particles_.size(); }
  /// Returns how many particles the sample stands for.
  std::size_t all() const { return all_; }

  OutputContext context(const std::string& directory) {
    OutputContext context;  // without the functions for probes
    context.title = model_.scene->title;
    context.fields = rest_.fields();
    context.directory = directory;
    context.self = this;
    context.region_particles = [](void* self, RegionId region) noexcept {
      return PluginCall::answer(std::span<const Particle>(), [&] {
        return static_cast<ParticleSample*>(self)->particles(region);
      });
    };
    context.use_field = nullptr;
    return context;
  }

  Snapshot snapshot() {
    Snapshot snapshot;
    snapshot.time = 1e-4 / 3;
    snapshot.step = 1000;
    snapshot.particles = size();
    snapshot.spacing = model_.body.grid.spacing *
                       std::cbrt(static_cast<double>(all_) / static_cast<double>(size()));
    snapshot.positions = positions_;
    snapshot.self = this;
    snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
      return PluginCall::answer(
          false, [&] { return static_cast<ParticleSample*>(self)->field(name, field); });
    };
    return snapshot;
  }

 private:
  /// Returns the members of a region by their numbers in the sample.
  std::span<const Particle> particles(RegionId region) {
    const auto [entry, is_new] = places_.try_emplace(region.index);
    if (!is_new) return entry->second;
    const auto members = rest_.particles(region);
    for (std::size_t n = 0; n < particles_.size(); ++n)
      if (std::binary_search(members.begin(), members.end(), particles_[n]))
        entry->second.push_back(static_cast<Particle>(n));
    return entry->second;
  }

  bool field(std::string_view name, Field& field) {
    if (!has_field(model_, name)) return false;
    std::vector<double>& values = values_[std::string(name)];
    field.components = components_of(*field_of(model_, name));
    values.assign(field.components * size(), 0.0);  // nothing is broken
    if (name == "material")
      std::transform(particles_.begin(), particles_.end(), values.begin(),
                     [this](Particle particle) { return model_.kinds.material(particle); });
    else if (name == "source")
      std::transform(particles_.begin(), particles_.end(), values.begin(),
                     [this](Particle particle) { return model_.body.listed.source[particle]; });
    else if (name == "displacement" || name == "height")
      fill(values, 1e-3 * model_.body.grid.spacing);
    else if (const FieldNeeds needs = field_of(model_, name)->needs;
             needs != FieldNeeds::failure && needs != FieldNeeds::damage)
      fill(values, 1.0);
    field.values = values;
    return true;
  }

  /// Fills in numbers that change slowly along the body and have noise in their last digits. Their
  /// lowest bits are zero, so that they compress about as well as those of a body whose parts move
  /// partly alike, and have as many decimal digits as any.
  void fill(std::vector<double>& values, double size) const {
    constexpr double roughness = 1e-4,
                     middle = 0.37;  // a bit more than half of the numbers have no sign
    std::uint64_t noise = 1;
    for (std::size_t n = 0; n < values.size(); ++n) {
      noise = noise * 6364136223846793005U + 1442695040888963407U;  // Knuth's
      const double along = static_cast<double>(n) / static_cast<double>(values.size());
      const double value =
          size * (along - middle + roughness * std::ldexp(static_cast<double>(noise >> 11), -53));
      constexpr std::uint64_t left_out = (1U << 16) - 1;
      values[n] = model_.springs.choice.precision == Precision::floats
                      ? static_cast<double>(static_cast<float>(value))
                      : std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & ~left_out);
    }
  }

  const Model& model_;
  BodyAtRest& rest_;
  std::size_t all_ = 0;
  std::vector<Particle> particles_;  ///< their numbers in the body
  std::vector<double> positions_;
  std::map<std::uint32_t, std::vector<Particle>> places_;  ///< members of each region
  std::map<std::string, std::vector<double>, std::less<>> values_;
};

/// Returns the cost of a frame of the sample, or nothing if it cannot be written here.
std::optional<FrameCost> try_frame(const Stage& stage, ParticleSample& sample) try {
  using Clock = std::chrono::steady_clock;
  // Seconds. A faster first frame is repeated, because it may include preparations that later
  // frames do not need.
  constexpr double quick = 0.01;
  const FileLimitGuard file_limit;
  const TrialFolder folder;
  const auto& writer = stage.functions<WriterFunctions>();
  const ComponentPointer component = make_component(stage);
  const OutputContext context = sample.context(folder.path());
  if (refusal_of(stage, "begin",
                 [&](const Complaint& why) { return writer.begin(component.get(), context, why); }))
    return std::nullopt;
  const Snapshot snapshot = sample.snapshot();
  FrameCost cost{0, infinity};
  for (int n = 0; n < 2 && (n == 0 || cost.seconds < quick); ++n) {
    const auto start = Clock::now();
    if (refusal_of(stage, "frame", [&](const Complaint& why) {
          return writer.frame(component.get(), snapshot, why);
        }))
      return std::nullopt;
    cost.seconds =
        std::min(cost.seconds, std::chrono::duration<double>(Clock::now() - start).count());
    if (n == 0) cost.bytes = folder.bytes();
  }
  if (refusal_of(stage, "end",
                 [&](const Complaint& why) { return writer.end(component.get(), why); }))
    return std::nullopt;
  return cost;
} catch (const std::exception&) {
  return std::nullopt;
}

/// Returns the same. If memory runs out here, this is forgotten: the run reports the failure if it
/// meets it too.
std::optional<FrameCost> cost_of(const Stage& stage, ParticleSample& sample) {
  const auto cost = try_frame(stage, sample);
  if (!cost) forget_lack_of_memory();
  return cost;
}

/// Returns the cost for all particles. It grows as a power of their number: about 1 for a table,
/// nearly 0 for a picture.
double of_all(double all, double few, double cost_of_few, double some, double cost_of_some) {
  const bool grows = cost_of_few > 0 && cost_of_some > cost_of_few;
  const double power =
      grows ? std::min(1.0, std::log(cost_of_some / cost_of_few) / std::log(some / few)) : 0.0;
  return cost_of_some * std::pow(all / some, power);
}

/// Returns the cost of a frame of all particles that the writer shows, extrapolated from frames of
/// a few and of some particles. If the frame of some particles cannot be written, because files may
/// be limited in size, the cost is proportional to that of a few.
std::optional<FrameCost> frame_cost(const Model& model, BodyAtRest& rest, const Stage& stage,
                                    const std::vector<RegionId>& regions) {
  constexpr std::size_t few_particles = 256, some_particles = 8192;
  // Seconds: much longer than so few particles take, so that their number matters little.
  constexpr double long_time = 0.5;
  ParticleSample some(model, rest, regions, some_particles);
  const auto all = static_cast<double>(some.all());
  if (all == 0) return std::nullopt;
  const auto cost = cost_of(stage, some);
  if (cost && (some.all() == some.size() || cost->seconds > long_time)) return cost;
  ParticleSample few(model, rest, regions, few_particles);
  const auto least = cost_of(stage, few);
  if (!least) return cost;
  const auto number = static_cast<double>(few.size());
  if (!cost) return FrameCost{least->bytes * all / number, least->seconds * all / number};
  const auto more = static_cast<double>(some.size());
  return FrameCost{of_all(all, number, least->bytes, more, cost->bytes),
                   of_all(all, number, least->seconds, more, cost->seconds)};
}

/// Returns whether the stage has a fault already.
bool has_fault(const Stage& stage, const Faults& faults) {
  return std::any_of(faults.all().begin(), faults.all().end(), [&](const Fault& fault) {
    return fault.pointer == stage.pointer || fault.pointer.starts_with(stage.pointer + "/");
  });
}

}  // namespace

void try_outputs(Plan& plan, Faults& faults) {
  const auto probes = plan.scene->of(Family::probes), writers = plan.scene->of(Family::writers);
  if (probes.empty() && writers.empty()) return;
  BodyAtRest rest(*plan.model);
  const OutputContext context = rest.context();
  for (const Stage* stage : writers) {
    if (has_fault(*stage, faults)) continue;
    const ComponentPointer writer = make_component(*stage);
    rest.forget();
    const auto refused = refusal_of(*stage, "begin", [&](const Complaint& why) {
      return stage->functions<WriterFunctions>().begin(writer.get(), context, why);
    });
    if (refused) {
      add_all(faults, objection(*plan.scene, *stage, *refused));
      continue;
    }
    plan.used_fields[stage] = rest.used_fields();
    plan.needs[stage] = rest.needs();
    for (const std::string& warning : rest.warnings())
      plan.model->warnings.push_back(writer_warning(*stage, warning));
    if (const auto memory = stage->functions<WriterFunctions>().memory; memory != nullptr)
      plan.writer_bytes[stage] = std::max(0.0, memory(writer.get()));
    if (!faults.empty()) continue;
    if (const auto cost = frame_cost(*plan.model, rest, *stage, rest.asked_regions()))
      plan.frame_costs[stage] = *cost;
  }
  if (probes.empty()) return;
  const Snapshot snapshot = rest.snapshot(faults);
  for (const Stage* stage : probes) {
    if (has_fault(*stage, faults)) continue;
    const ComponentPointer probe = make_component(*stage);
    rest.forget();
    std::vector<std::string>& names =
        plan.tables.emplace_back(PlannedTable{stage->name, {"time"}}).columns;
    const auto refused = refusal_of(*stage, "begin", [&](const Complaint& why) {
      return stage->functions<ProbeFunctions>().begin(probe.get(), context, snapshot,
                                                      columns_into(names), why);
    });
    plan.needs[stage] = rest.needs();
    std::set<std::string_view> different;
    for (const std::string& name : names)
      if (!different.insert(name).second)
        throw plugin_error(*stage, "begin",
                           fmt::format("it gives two columns the name \"{}\"", name));
    if (refused) add_all(faults, objection(*plan.scene, *stage, *refused));
  }
}

}  // namespace hyperlattice
