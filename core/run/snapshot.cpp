#include <host/plugin_call.hpp>
#include <plan/fields.hpp>
#include <run/snapshot.hpp>
#include <run/writer_tasks.hpp>
#include <state/crack_faces.hpp>
#include <state/force_sums.hpp>
#include <state/fragments.hpp>
#include <state/particle_stress.hpp>

#include <hyperlattice/fields.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Writes of each value the numbers that of(value, out) returns, `components` of them.
template <class T, class Of>
void fill(std::vector<double>& numbers, const std::vector<T>& values, std::size_t components,
          const Of& of) {
  numbers.resize(components * values.size());
  for (std::size_t n = 0; n < values.size(); ++n) of(values[n], &numbers[components * n]);
}

void copy(const Symmetric& from, double* to) { std::copy(from.begin(), from.end(), to); }
void copy(Vec3 from, double* to) {
  for (std::size_t c = 0; c < 3; ++c) to[c] = from[c];
}
void copy(const Tensor& from, double* to) {
  for (std::size_t row = 0; row < 3; ++row) copy(from[row], to + 3 * row);
}

}  // namespace

SnapshotSource::SnapshotSource(const Model& model, Simulation& simulation)
    : model_(model), simulation_(simulation) {
  snapshot_.particles = model.body.particles;
  snapshot_.spacing = model.body.grid.spacing;
  snapshot_.self = this;
  snapshot_.get_field = [](void* self, std::string_view name, Field& out) noexcept {
    return PluginCall::answer(false,
                              [&] { return static_cast<SnapshotSource*>(self)->field(name, out); });
  };
  snapshot_.get_resultant = [](void* self, ForcesId forces, Vec3 about) noexcept {
    return PluginCall::answer(
        Resultant(), [&] { return static_cast<SnapshotSource*>(self)->resultant(forces, about); });
  };
  snapshot_.get_fragments = [](void* self, double damage, Field& out) noexcept {
    return PluginCall::answer(false, [&] {
      out = {1, static_cast<SnapshotSource*>(self)->fragments(damage)};
      return true;
    });
  };
  snapshot_.get_crack_faces = [](void* self, double damage) noexcept {
    return PluginCall::answer(std::span<const CrackFace>(), [&] {
      return static_cast<SnapshotSource*>(self)->crack_faces(damage);
    });
  };
  snapshot_.get_cubes = [](void* self) noexcept {
    return PluginCall::answer(BodyCubes(),
                              [&] { return static_cast<SnapshotSource*>(self)->cubes(); });
  };
  snapshot_.run_tasks = [](void* self, std::uint64_t count, void* work,
                           void (*task)(void* work, std::uint64_t n) noexcept) noexcept {
    run_writer_tasks(static_cast<SnapshotSource*>(self)->simulation_.team(), count, work, task);
  };
}

void SnapshotSource::renew() {
  for (auto& [name, values] : fields_) values.current = false;
  has_collected_only_ = false;
  forces_current_ = false;
  measured_.reset();
  cubes_ = {};
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
  if (!measured_) measured_.emplace(model_, simulation_);
  snapshot_.time = simulation_.time();
  snapshot_.step = simulation_.steps();
  return snapshot_;
}

SnapshotSource::Compute SnapshotSource::function_of(std::string_view name) {
  static constexpr std::pair<std::string_view, Compute> functions[] = {
      {"displacement", &SnapshotSource::displacement},
      {"velocity", &SnapshotSource::velocity},
      {"height", &SnapshotSource::height},
      {"material", &SnapshotSource::material},
      {"source", &SnapshotSource::source},
      {"mass", &SnapshotSource::mass},
      {"volume", &SnapshotSource::volume},
      {"broken_open", &SnapshotSource::broken_open},
      {"broken_closed", &SnapshotSource::broken_closed},
      {"damage", &SnapshotSource::damage},
      {"crack_opening", &SnapshotSource::crack_opening},
      {"crack_time", &SnapshotSource::crack_time},
      {"fragment", &SnapshotSource::fragment},
      {"stress", &SnapshotSource::stress},
      {"nominal_stress", &SnapshotSource::nominal_stress},
      {"principal_stress", &SnapshotSource::principal_stress},
      {"principal_direction_1", &SnapshotSource::principal_direction<0>},
      {"principal_direction_2", &SnapshotSource::principal_direction<1>},
      {"principal_direction_3", &SnapshotSource::principal_direction<2>},
      {"von_mises", &SnapshotSource::von_mises},
      {"pressure", &SnapshotSource::pressure},
      {"strain", &SnapshotSource::strain},
      {"hencky_strain", &SnapshotSource::hencky_strain},
      {"strain_rate", &SnapshotSource::strain_rate},
      {"energy_density", &SnapshotSource::energy_density},
      {"kinetic_energy_density", &SnapshotSource::kinetic_energy_density},
      {"internal_force", &SnapshotSource::internal_force},
      {"external_force", &SnapshotSource::external_force},
      {"force", &SnapshotSource::force},
      {"acceleration", &SnapshotSource::acceleration}};
  static_assert(std::size(functions) == std::size(field_table));
  for (const auto& [field, function] : functions)
    if (field == name) return function;
  return nullptr;
}

void SnapshotSource::collect(const std::set<Simulation::Motion>& motions) {
  static constexpr std::pair<const char*, Simulation::Motion> names[] = {
      {"displacement", Simulation::Motion::displacement},
      {"velocity", Simulation::Motion::velocity},
      {"height", Simulation::Motion::height}};
  for (const auto& [name, motion] : names) {
    if (!motions.contains(motion)) continue;
    FieldValues& values = fields_[name];
    simulation_.copy_to_first(motion, values.numbers);
    values.components = motion == Simulation::Motion::height ? 1 : 3;
    values.current = true;
  }
  has_collected_only_ = true;
}

void SnapshotSource::must_have_state(std::string_view what) const {
  if (has_collected_only_)
    throw PluginMistake(fmt::format(
        "it asks for {}, which it did not name in begin(): a run on several ranks brings to the "
        "first one what was named",
        what));
}

void SnapshotSource::compute(std::string_view name, FieldValues& values) {
  if (!is_constant_field(name)) must_have_state(name);
  values.components = components_of(*field_of(model_, name));
  if (const Compute function = function_of(name); function != nullptr)
    (this->*function)(values.numbers);
  else
    simulation_.law_field(name, values.numbers);
}

bool SnapshotSource::field(std::string_view name, Field& out) {
  if (!has_field(model_, name)) return false;
  FieldValues& values = fields_.try_emplace(std::string(name)).first->second;
  if (!values.current) compute(name, values);
  values.current = true;
  out = {values.components, values.numbers};
  return true;
}

void SnapshotSource::displacement(std::vector<double>& numbers) {
  simulation_.displacements(numbers);
}
void SnapshotSource::velocity(std::vector<double>& numbers) { simulation_.velocities(numbers); }
void SnapshotSource::height(std::vector<double>& numbers) { simulation_.heights(numbers); }

void SnapshotSource::material(std::vector<double>& numbers) {
  numbers.resize(model_.body.particles);
  for (Particle particle = 0; particle < model_.body.particles; ++particle)
    numbers[particle] = model_.kinds.material(particle);
}

void SnapshotSource::source(std::vector<double>& numbers) {
  numbers.assign(model_.body.listed.source.begin(), model_.body.listed.source.end());
}

void SnapshotSource::mass(std::vector<double>& numbers) {
  numbers.resize(model_.body.particles);
  for (Particle p = 0; p < model_.body.particles; ++p) numbers[p] = model_.mass(p);
}

void SnapshotSource::volume(std::vector<double>& numbers) {
  numbers.resize(model_.body.particles);
  for (Particle p = 0; p < model_.body.particles; ++p)
    numbers[p] = model_.body.share(p) * model_.body.grid.site_volume;
}

void SnapshotSource::fragment(std::vector<double>& numbers) {
  if (masses_.empty()) mass(masses_);
  numbers = hyperlattice::fragments(measured_->springs(), masses_, 1);
}

std::span<const double> SnapshotSource::fragments(double damage) {
  if (damage == 1) {
    Field field;
    this->field("fragment", field);
    return field.values;
  }
  must_have_state("fragments");
  if (masses_.empty()) mass(masses_);
  fragments_ = hyperlattice::fragments(measured_->springs(), masses_, damage);
  return fragments_;
}

std::span<const CrackFace> SnapshotSource::crack_faces(double damage) {
  must_have_state("the faces of cracks");
  crack_faces_ = hyperlattice::crack_faces(model_, simulation_, damage);
  return crack_faces_;
}

BodyCubes SnapshotSource::cubes() {
  if (cubes_.particle.empty()) cubes_ = cubes_of(model_.body);
  return cubes_.view();
}

void SnapshotSource::stress(std::vector<double>& numbers) {
  fill(numbers, measured_->stresses(), 6, [](const Symmetric& of, double* out) { copy(of, out); });
}

void SnapshotSource::nominal_stress(std::vector<double>& numbers) {
  fill(numbers, nominal_stresses(measured_->springs()), 9,
       [](const Tensor& of, double* out) { copy(of, out); });
}

void SnapshotSource::principal_stress(std::vector<double>& numbers) {
  fill(numbers, measured_->principals(), 3,
       [](const Principal& of, double* out) { copy(of.values, out); });
}

template <std::size_t n>
void SnapshotSource::principal_direction(std::vector<double>& numbers) {
  fill(numbers, measured_->principals(), 3,
       [](const Principal& of, double* out) { copy(of.directions[n], out); });
}

void SnapshotSource::von_mises(std::vector<double>& numbers) {
  fill(numbers, measured_->stresses(), 1,
       [](const Symmetric& of, double* out) { *out = hyperlattice::von_mises(of); });
}

void SnapshotSource::pressure(std::vector<double>& numbers) {
  fill(numbers, measured_->stresses(), 1,
       [](const Symmetric& of, double* out) { *out = hyperlattice::pressure(of); });
}

void SnapshotSource::strain(std::vector<double>& numbers) {
  fill(numbers, measured_->gradients(), 6,
       [](const Tensor& H, double* out) { copy(green_lagrange_strain(H), out); });
}

void SnapshotSource::hencky_strain(std::vector<double>& numbers) {
  fill(numbers, measured_->gradients(), 6,
       [](const Tensor& H, double* out) { copy(hyperlattice::hencky_strain(H), out); });
}

void SnapshotSource::strain_rate(std::vector<double>& numbers) {
  std::vector<double> velocities;
  simulation_.velocities(velocities);
  const std::vector<Tensor>& H = measured_->gradients();
  const std::vector<Tensor> rates = gradients(measured_->springs(), velocities);
  numbers.resize(6 * H.size());
  for (std::size_t n = 0; n < H.size(); ++n)
    copy(hyperlattice::strain_rate(H[n], rates[n]), &numbers[6 * n]);
}

void SnapshotSource::energy_density(std::vector<double>& numbers) {
  numbers = energy_densities(measured_->springs());
}

void SnapshotSource::kinetic_energy_density(std::vector<double>& numbers) {
  std::vector<double> velocities, rates;
  simulation_.velocities(velocities);
  simulation_.height_rates(rates);
  numbers.resize(model_.body.particles);
  for (Particle p = 0; p < model_.body.particles; ++p) {
    const Vec3 v{velocities[3 * p], velocities[3 * p + 1], velocities[3 * p + 2]};
    const double rise = rates.empty() ? 0 : rates[p],
                 density = model_.kinds.masses[model_.kinds.of(p)] / model_.body.grid.site_volume *
                           (simulation_.inertia(p) / model_.mass(p));
    numbers[p] = density / 2 * (dot(v, v) + rise * rise);
  }
}

void SnapshotSource::internal_force(std::vector<double>& numbers) {
  fill(numbers, measured_->internal_forces(), 3, [](Vec3 of, double* out) { copy(of, out); });
}

void SnapshotSource::external_force(std::vector<double>& numbers) {
  fill(numbers, measured_->external_forces(), 3, [](Vec3 of, double* out) { copy(of, out); });
}

void SnapshotSource::force(std::vector<double>& numbers) {
  const std::vector<Vec3>&inner = measured_->internal_forces(),
        &outer_forces = measured_->external_forces();
  numbers.resize(3 * inner.size());
  for (Particle p = 0; p < inner.size(); ++p) copy(inner[p] + outer_forces[p], &numbers[3 * p]);
}

void SnapshotSource::acceleration(std::vector<double>& numbers) {
  force(numbers);
  for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] /= simulation_.inertia(n / 3);
}

Resultant SnapshotSource::resultant(ForcesId forces, Vec3 about) {
  if (forces.index >= simulation_.force_sums().size())
    throw PluginMistake("it asks for forces that it did not name in begin()");
  must_have_state("forces");
  if (!forces_current_) simulation_.force_sums().measure();
  forces_current_ = true;
  return simulation_.force_sums().sum(forces, about);
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

void SnapshotSource::count_broken(std::vector<double>& numbers, bool open) {
  numbers.assign(model_.body.particles, 0.0);
  const std::vector<Breakage>& breakages = simulation_.breakages();
  for (std::size_t n = 0; n < breakages.size(); ++n) {
    if (breakages[n].again || (simulation_.elongation_now(n) > 0) != open) continue;
    numbers[breakages[n].a] += 1;
    numbers[breakages[n].b] += 1;
  }
}

void SnapshotSource::damage(std::vector<double>& numbers) {
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
  for (const WeakenedSpring& spring : simulation_.weakened_springs())
    for (const Particle end : {spring.a, spring.b}) numbers[end] += 1 - spring.integrity;
  for (Particle a = 0; a < body.particles; ++a)
    if (springs_of_[a] > 0) numbers[a] /= springs_of_[a];
  if (!model_.cohesive.empty()) simulation_.copy_damage(numbers);
}

}  // namespace hyperlattice
