#include <base/errors.hpp>
#include <base/figures.hpp>
#include <host/plugin_call.hpp>
#include <model/section.hpp>
#include <plan/body_at_rest.hpp>
#include <plan/writer_warning.hpp>
#include <process/room.hpp>
#include <state/crack_faces.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

BodyAtRest::BodyAtRest(const Model& model)
    : model_(model),
      regions_(model.body, model.scene->regions),
      acted_(model, regions_),
      fields_(fields_of(model)) {}

OutputContext BodyAtRest::context() {
  OutputContext context;
  context.title = model_.scene->title;
  context.fields = fields_;
  context.self = this;
  context.region_particles = [](void* self, RegionId region) noexcept {
    return PluginCall::answer(std::span<const Particle>(), [&] {
      auto& rest = *static_cast<BodyAtRest*>(self);
      rest.asked_regions_.push_back(region);
      return rest.regions_.particles(region);
    });
  };
  context.acted_particles = [](void* self, LoadOrRegion of) noexcept {
    return PluginCall::answer(std::span<const Particle>(),
                              [&] { return static_cast<BodyAtRest*>(self)->acted_.particles(of); });
  };
  context.external_forces = [](void* self, LoadOrRegion) noexcept {
    static_cast<BodyAtRest*>(self)->asked_forces_ = true;
    return ForcesId();
  };
  context.cut_section = [](void* self, Vec3 point, Vec3 normal, RegionId region) noexcept {
    return PluginCall::answer(Section(), [&] {
      auto& rest = *static_cast<BodyAtRest*>(self);
      rest.asked_forces_ = true;
      const PlaneSection section = cut(rest.model_, point, normal, rest.regions_.particles(region));
      return Section{{}, section.springs.size(), section.area};
    });
  };
  context.get_cut_faces = [](void* self) noexcept {
    return PluginCall::answer(std::span<const CrackFace>(), [&] {
      auto& rest = *static_cast<BodyAtRest*>(self);
      if (rest.cut_faces_.empty()) rest.cut_faces_ = cut_faces(rest.model_);
      return std::span<const CrackFace>(rest.cut_faces_);
    });
  };
  context.use_field = [](void* self, std::string_view name) noexcept {
    PluginCall::answer([&] {
      auto& rest = *static_cast<BodyAtRest*>(self);
      if (has_field(rest.model_, name)) rest.used_fields_.emplace_back(name);
    });
  };
  context.receive_warning = [](void* self, std::string_view sentence) noexcept {
    PluginCall::answer([&] {
      auto& warnings = static_cast<BodyAtRest*>(self)->warnings_;
      if (warnings.size() < most_writer_warnings) warnings.emplace_back(sentence);
    });
  };
  return context;
}

Snapshot BodyAtRest::snapshot(const Faults& faults) {
  check_room(faults);
  positions_.reserve(3 * model_.body.particles);
  for (Particle particle = 0; particle < model_.body.particles; ++particle) {
    const Vec3 x = model_.body.position(particle);
    positions_.insert(positions_.end(), {x.x, x.y, x.z});
  }
  Snapshot snapshot;
  snapshot.particles = model_.body.particles;
  snapshot.spacing = model_.body.grid.spacing;
  snapshot.positions = positions_;
  snapshot.self = this;
  snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
    return PluginCall::answer(false,
                              [&] { return static_cast<BodyAtRest*>(self)->field(name, field); });
  };
  return snapshot;
}

void BodyAtRest::forget() {
  asked_regions_.clear();
  used_fields_.clear();
  warnings_.clear();
  asked_forces_ = false;
}

OutputNeeds BodyAtRest::needs() const {
  const bool all_simple = std::all_of(used_fields_.begin(), used_fields_.end(), is_of_particle);
  return {{used_fields_.begin(), used_fields_.end()},
          asked_forces_ || used_fields_.empty() || !all_simple};
}

void BodyAtRest::check_room(const Faults& faults) const {
  const double needed = 6.0 * sizeof(double) * static_cast<double>(model_.body.particles);
  const Room room = memory_room();
  if (needed <= room.bytes) return;
  faults.throw_if_any();
  throw OutsideError(fmt::format("not enough memory to try the probes: {} are needed, {} left; {}",
                                 bytes_text(needed), bytes_text(room.bytes), room.bound));
}

bool BodyAtRest::field(std::string_view name, Field& field) {
  if (!has_field(model_, name)) return false;
  field.components = components_of(*field_of(model_, name));
  std::vector<double>& zeros = zeros_[field.components];
  zeros.resize(field.components * model_.body.particles);
  field.values = zeros;
  return true;
}

}  // namespace hyperlattice
