#include <host/plugin_call.hpp>
#include <plan/fields.hpp>
#include <run/snapshot.hpp>

#include <algorithm>

namespace hyperlattice {

SnapshotSource::SnapshotSource(const Model& model, const Simulation& simulation)
    : model_(model), simulation_(simulation) {
  snapshot_.particles = model.body.particles;
  snapshot_.spacing = model.body.grid.spacing;
  snapshot_.self = this;
  snapshot_.get_field = [](void* self, std::string_view name, Field& out) noexcept {
    return PluginCall::answer(false,
                              [&] { return static_cast<SnapshotSource*>(self)->field(name, out); });
  };
}

const Snapshot& SnapshotSource::take() {
  if (positions_.empty()) {
    positions_.reserve(3 * model_.body.particles);
    for (Particle particle = 0; particle < model_.body.particles; ++particle) {
      const Vec3 x = model_.body.position(particle);
      positions_.insert(positions_.end(), {x.x, x.y, x.z});
    }
    snapshot_.positions = positions_;
  }
  for (auto& [name, values] : fields_) values.current = false;
  snapshot_.time = simulation_.time();
  snapshot_.step = simulation_.steps();
  return snapshot_;
}

bool SnapshotSource::field(std::string_view name, Field& out) {
  if (!has_field(model_, name)) return false;
  FieldValues& values = fields_.try_emplace(std::string(name)).first->second;
  if (!values.current && !compute(name, values)) return false;
  values.current = true;
  out = {values.components, values.numbers};
  return true;
}

void SnapshotSource::hand_over(std::string_view name, FieldValues& values) {
  const auto own = fields_.find(name);
  if (own != fields_.end() && own->second.current)
    std::swap(values, own->second);  // a probe asked for it
  else
    compute(name, values);
  if (own != fields_.end()) own->second.current = false;
  values.current = true;
}

bool SnapshotSource::compute(std::string_view name, FieldValues& values) {
  values.components = name == "displacement" || name == "velocity" ? 3 : 1;
  if (name == "displacement")
    simulation_.displacements(values.numbers);
  else if (name == "velocity")
    simulation_.velocities(values.numbers);
  else if (name == "height")
    simulation_.heights(values.numbers);
  else if (name == "material") {
    values.numbers.resize(model_.body.particles);
    for (Particle particle = 0; particle < model_.body.particles; ++particle)
      values.numbers[particle] = model_.kinds.material(particle);
  } else if (name == "source")
    values.numbers.assign(model_.body.listed.source.begin(), model_.body.listed.source.end());
  else if (name == "broken_open")
    count_broken(values.numbers, true);
  else if (name == "broken_closed")
    count_broken(values.numbers, false);
  else if (name == "damage")
    compute_damage(values.numbers);
  else
    return false;
  return true;
}

void SnapshotSource::count_broken(std::vector<double>& numbers, bool open) {
  numbers.assign(model_.body.particles, 0.0);
  const std::vector<Breakage>& breakages = simulation_.breakages();
  for (std::size_t n = 0; n < breakages.size(); ++n) {
    if (breakages[n].again || (simulation_.elongation_now(n) > 0) != open) continue;
    numbers[breakages[n].a] += 1;
    numbers[breakages[n].b] += 1;
  }
}

void SnapshotSource::compute_damage(std::vector<double>& numbers) {
  const Body& body = model_.body;
  if (springs_of_.empty()) {
    springs_of_.assign(body.particles, 0);
    body.for_springs([this](Particle a, Particle b, std::uint32_t) {
      ++springs_of_[a];
      ++springs_of_[b];
    });
  }
  numbers.assign(body.particles, 0.0);
  for (const Breakage& breakage : simulation_.breakages()) {
    if (breakage.softened) continue;  // the spring is still there, with the integrity 0
    numbers[breakage.a] += 1;
    numbers[breakage.b] += 1;
  }
  if (model_.springs.softens) simulation_.add_softening(numbers);
  for (Particle a = 0; a < body.particles; ++a)
    if (springs_of_[a] > 0) numbers[a] /= springs_of_[a];
}

}  // namespace hyperlattice
