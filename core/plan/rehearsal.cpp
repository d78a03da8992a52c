#include <base/errors.hpp>
#include <base/figures.hpp>
#include <model/region_index.hpp>
#include <plan/columns.hpp>
#include <plan/fields.hpp>
#include <plan/rehearsal.hpp>
#include <process/room.hpp>
#include <scene/stage_call.hpp>

#include <hyperlattice/output.hpp>

#include <spdlog/fmt/fmt.h>

#include <set>

namespace hyperlattice {
namespace {

/// The body at rest: every field that the run has is zero.
class AtRest {
 public:
  explicit AtRest(const Model& model) : model_(model), regions_(model.body, model.scene->regions) {
    for (const std::string_view name : field_names)
      if (has_field(model, name)) fields_.push_back(name);
  }

  OutputContext context() {
    OutputContext context;
    context.title = model_.scene->title;
    context.fields = fields_;
    context.self = this;
    context.region_particles = [](void* self, RegionId region) noexcept {
      return PluginCall::answer(std::span<const Particle>(), [&] { return static_cast<AtRest*>(self)->regions_.particles(region); });
    };
    return context;
  }

  /// What probes are shown; writers need none of it.
  Snapshot snapshot() {
    check_room();
    positions_.reserve(3 * model_.body.particles);
    for (Particle particle = 0; particle < model_.body.particles; ++particle) {
      const Vec3 x = model_.body.position(particle);
      positions_.insert(positions_.end(), {x.x, x.y, x.z});
    }
    zeros_.assign(positions_.size(), 0.0);
    Snapshot snapshot;
    snapshot.particles = model_.body.particles;
    snapshot.spacing = model_.body.grid.spacing;
    snapshot.positions = positions_;
    snapshot.self = this;
    snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
      const auto& rest = *static_cast<AtRest*>(self);
      field.components = name == "displacement" || name == "velocity" ? 3 : 1;
      field.values = std::span(rest.zeros_).first(field.components * rest.model_.body.particles);
      return has_field(rest.model_, name);
    };
    return snapshot;
  }

 private:
  void check_room() const {
    const double needed = 6.0 * sizeof(double) * static_cast<double>(model_.body.particles);
    if (const Room room = memory_room(); needed > room.bytes)
      throw OutsideError(
          fmt::format("not enough memory to try the probes: {} are needed, {} left; {}", bytes_text(needed), bytes_text(room.bytes), room.bound));
  }

  const Model& model_;
  RegionIndex regions_;
  std::vector<std::string_view> fields_;
  std::vector<double> positions_, zeros_;
};

}  // namespace

void rehearse_outputs(Plan& plan, Faults& faults) {
  const auto probes = plan.scene->of(Family::probes), writers = plan.scene->of(Family::writers);
  if (probes.empty() && writers.empty()) return;
  AtRest rest(*plan.model);
  const OutputContext context = rest.context();
  for (const Stage* stage : writers) {
    const ComponentPointer writer = make_component(*stage);
    const auto refused =
        refusal_of(*stage, "begin", [&](const Complaint& why) { return stage->functions<WriterFunctions>().begin(writer.get(), context, why); });
    if (refused) faults.add(stage->pointer, stage->component->type(), "an output that fits the body: " + *refused);
  }
  if (probes.empty()) return;
  const Snapshot snapshot = rest.snapshot();
  for (const Stage* stage : probes) {
    const ComponentPointer probe = make_component(*stage);
    std::vector<std::string>& names = plan.tables.emplace_back(PlannedTable{stage->name, {"time"}}).columns;
    const auto refused = refusal_of(*stage, "begin", [&](const Complaint& why) {
      return stage->functions<ProbeFunctions>().begin(probe.get(), context, snapshot, columns_into(names), why);
    });
    std::set<std::string_view> different;
    for (const std::string& name : names)
      if (!different.insert(name).second) throw plugin_error(*stage, "begin", fmt::format("it gives two columns the name \"{}\"", name));
    if (refused) faults.add(stage->pointer, stage->component->type(), "an output that fits the body: " + *refused);
  }
}

}  // namespace hyperlattice
