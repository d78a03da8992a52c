// What a simulation tells about its body as a whole. Its other functions are in fields.cpp,
// equilibrium.cpp and restart.cpp.
#include <state/external_forces.hpp>
#include <state/load_work.hpp>
#include <state/state.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace hyperlattice {

Simulation::Simulation(const Model& model, int threads)
    : state_(std::make_unique<State>(model, threads)) {}
Simulation::~Simulation() = default;

void Simulation::set_damping(double alpha, double rate) { state_->sweeps.set_damping(alpha, rate); }
void Simulation::set_local_steps(double time_step, std::int64_t parts) {
  state_->local.start(time_step, parts);
}
void Simulation::set_added_mass(double time_step) { state_->set_added_mass(time_step); }
double Simulation::inertia(Particle particle) const {
  return state_->blocks.model().mass(particle) + state_->added.of(particle);
}
void Simulation::step(double time_step) { state_->step(time_step); }
void Simulation::set_time(double time) { state_->clock.set(time); }
double Simulation::time() const { return state_->clock.time(); }
std::uint64_t Simulation::steps() const { return state_->clock.steps(); }
double Simulation::last_step() const { return state_->clock.last_step(); }
void Simulation::in_parallel(std::size_t size, const std::function<void(std::size_t)>& work) const {
  state_->blocks.team().for_each(size, work);
}

double Simulation::kinetic() const { return state_->kinetic.now(); }
EnergyBalance Simulation::balance() { return state_->energy.balance(); }
void Simulation::reset_energy_balance() { state_->energy.clear_error(); }
std::vector<double> Simulation::injected_by_load() { return state_->energy.injected_by_load(); }
const std::vector<double>& Simulation::work_of_loads() const { return state_->energy.work(); }
std::span<double> Simulation::load_memory(std::size_t load) { return state_->loads.memory(load); }
ForceSums& Simulation::force_sums() { return state_->force_sums; }
std::vector<Vec3> Simulation::force_on_load() {
  state_->sweeps.measure(Sweep::present(state_->clock.last_step()));
  return force_by_load(state_->blocks);
}

std::vector<Vec3> Simulation::external_forces(const ForcesOnAll& internal) const {
  const State& state = *state_;
  state_->sweeps.set_loads(Sweep::present(state.clock.last_step()));
  return hyperlattice::external_forces(state.blocks, state.clock, state.loads, internal);
}

const std::vector<Breakage>& Simulation::breakages() const { return state_->failures.breakages(); }
double Simulation::elongation_now(std::size_t breakage) const {
  return state_->failures.elongation_now(breakage);
}
std::uint64_t Simulation::broken_open() const { return state_->failures.open(); }
std::uint64_t Simulation::broken() const { return state_->failures.springs(); }

std::vector<WeakenedSpring> Simulation::weakened_springs() const {
  std::vector<WeakenedSpring> weakened;
  if (state_->blocks.model().springs.softens) weakened = state_->law_memory.weakened();
  const std::vector<SoftSpring> soft = soft_springs();
  weakened.reserve(weakened.size() + soft.size());
  for (const SoftSpring& spring : soft)
    weakened.push_back({spring.a, spring.b, spring.neighbour, spring.factor});
  return weakened;
}

void Simulation::copy_damage(std::vector<double>& values) const {
  state_->damage.copy_damage(values);
}

void Simulation::crack_openings(std::vector<double>& values) const {
  state_->damage.copy_openings(values);
}
void Simulation::crack_times(std::vector<double>& values) const {
  state_->damage.copy_crack_times(values);
}

std::vector<SoftSpring> Simulation::soft_springs() const {
  return state_->damage.empty() ? std::vector<SoftSpring>{} : state_->damage.soft_springs();
}

std::vector<SoftParticle> Simulation::soft_particles() const {
  return state_->damage.empty() ? std::vector<SoftParticle>{} : state_->damage.soft_particles();
}

std::vector<SoftCell> Simulation::soft_cells() const {
  return state_->damage.empty() ? std::vector<SoftCell>{} : state_->damage.soft_cells();
}

CrackSurface Simulation::crack_surface() const {
  return state_->damage.empty() ? CrackSurface{} : state_->damage.surface();
}

void Simulation::law_field(std::string_view name, std::vector<double>& values) const {
  state_->law_memory.field(name, values);
}

Particle Simulation::fastest(double& speed, bool& finite) const {
  double largest = -1;
  Particle found = 0;
  finite = true;
  const int components = state_->blocks.model().degrees_of_freedom;
  state_->blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        if (!finite) return;
        for (std::uint64_t n = 0; n < count; ++n) {
          double square = 0;
          for (int c = 0; c < components; ++c)
            square += block.velocity[c][place + n] * block.velocity[c][place + n];
          if (!std::isfinite(square)) {
            finite = false;
            found = first + n;
            largest = square;
            return;
          }
          if (square > largest) {
            largest = square;
            found = first + n;
          }
        }
      });
  speed = std::sqrt(largest);
  return found;
}

double Simulation::farthest() const {
  double largest = 0;
  state_->blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle, std::uint64_t count) {
        for (std::uint64_t n = place; n < place + count; ++n)
          largest = std::max(largest, norm({block.displacement[0][n], block.displacement[1][n],
                                            block.displacement[2][n]}));
      });
  return largest;
}

std::uint64_t Simulation::hash() const {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](std::uint64_t bits) {
    hash = (hash ^ bits) * 1099511628211u;
  };  // FNV-1a, a word at a time
  const int components = state_->blocks.model().degrees_of_freedom;
  state_->blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle, std::uint64_t count) {
        for (std::uint64_t n = place; n < place + count; ++n) {
          for (int c = 0; c < components; ++c) {
            add(std::bit_cast<std::uint64_t>(block.displacement[c][n]));
            add(std::bit_cast<std::uint64_t>(block.velocity[c][n]));
          }
          add(state_->blocks.layout().alive_bits(block, n));
        }
      });
  if (!state_->damage.empty())
    state_->damage.for_damaged([&](Particle particle, double damage, double rate) {
      add(particle);
      add(std::bit_cast<std::uint64_t>(damage));
      add(std::bit_cast<std::uint64_t>(rate));
    });
  state_->loads.for_memory([&](double number) { add(std::bit_cast<std::uint64_t>(number)); });
  return hash;
}

double Simulation::bytes() const { return state_->blocks.layout().state_bytes(); }
double Simulation::scratch_bytes() const { return state_->blocks.layout().scratch_bytes(); }

}  // namespace hyperlattice
