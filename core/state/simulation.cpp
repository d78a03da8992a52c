// What a simulation tells about its body as a whole. Its other functions are in fields.cpp,
// equilibrium.cpp and restart.cpp.
#include <state/external_forces.hpp>
#include <state/load_work.hpp>
#include <state/state.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace hyperlattice {

namespace {

/// Finds the largest square of a speed of all ranks and the lowest particle that has it, and the
/// lowest particle without a finite speed.
void agree_on_fastest(Ranks& ranks, double& square, Particle& fastest, Particle& bad) {
  ranks.meet(Ranks::Meeting::speed);
  // Bits of numbers that are not negative have the order of the numbers.
  const auto bits = std::bit_cast<std::int64_t>(square);
  const auto lowest = [](Particle particle) { return -static_cast<std::int64_t>(particle); };
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::min();
  std::array<std::int64_t, 2> all{bits, bad == Body::no_particle ? none : lowest(bad)};
  ranks.largest(all);
  std::array<std::int64_t, 1> first{bits == all[0] ? lowest(fastest) : none};
  ranks.largest(first);
  square = std::bit_cast<double>(all[0]);
  fastest = static_cast<Particle>(-first[0]);
  bad = all[1] == none ? Body::no_particle : static_cast<Particle>(-all[1]);
}

}  // namespace

Simulation::Simulation(const Model& model, int threads)
    : Simulation(model, threads, Ranks::alone(), threads) {}
Simulation::Simulation(const Model& model, int threads, Ranks& ranks, int blocks)
    : state_(std::make_unique<State>(model, threads, ranks, blocks)) {}
Simulation::~Simulation() = default;

void Simulation::set_damping(double alpha, double rate) {
  const bool damped = damps();
  state_->sweeps.set_damping(alpha, rate);
  if (damped || damps()) state_->energy.count_intervention();
}
bool Simulation::damps() const { return state_->sweeps.damps(); }
void Simulation::set_local_steps(double time_step, std::int64_t parts) {
  if (parts > 1) {
    state_->blocks.keep_whole();
    gather();
  }
  state_->local.start(time_step, parts);
}
void Simulation::set_added_mass(double time_step) { state_->set_added_mass(time_step); }
double Simulation::inertia(Particle particle) const {
  return state_->blocks.model().mass(particle) + state_->added.of(particle);
}

/// Returns the state with all blocks up to date.
Simulation::State& Simulation::whole() const {
  state_->blocks.gather();
  state_->damage.gather();
  return *state_;
}
void Simulation::gather() const { whole(); }
void Simulation::gather_in_first() const {
  state_->blocks.gather_in_first();
  state_->damage.gather();
}

void Simulation::step(double time_step) { state_->step(time_step); }
void Simulation::set_time(double time) { state_->clock.set(time); }
double Simulation::time() const { return state_->clock.time(); }
std::uint64_t Simulation::steps() const { return state_->clock.steps(); }
double Simulation::last_step() const { return state_->clock.last_step(); }
void Simulation::in_parallel(std::size_t size, const std::function<void(std::size_t)>& work) const {
  state_->blocks.team().for_each(size, work);
}

double Simulation::kinetic() const { return whole().kinetic.now(); }
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
  const State& state = whole();
  state_->sweeps.set_loads(Sweep::present(state.clock.last_step()));
  return hyperlattice::external_forces(state.blocks, state.clock, state.loads, internal);
}

const std::vector<Breakage>& Simulation::breakages() const { return state_->failures.breakages(); }
double Simulation::elongation_now(std::size_t breakage) const {
  return whole().failures.elongation_now(breakage);
}
std::uint64_t Simulation::broken_open() const { return state_->failures.open(); }
std::uint64_t Simulation::broken() const { return state_->failures.springs(); }

std::vector<WeakenedSpring> Simulation::weakened_springs() const {
  std::vector<WeakenedSpring> weakened;
  if (state_->blocks.model().springs.softens) weakened = whole().law_memory.weakened();
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
  return state_->damage.empty() ? std::vector<SoftSpring>{} : whole().damage.soft_springs();
}

std::vector<SoftParticle> Simulation::soft_particles() const {
  return state_->damage.empty() ? std::vector<SoftParticle>{} : whole().damage.soft_particles();
}

std::vector<SoftCell> Simulation::soft_cells() const {
  return state_->damage.empty() ? std::vector<SoftCell>{} : whole().damage.soft_cells();
}

CrackSurface Simulation::crack_surface() const {
  return state_->damage.empty() ? CrackSurface{} : state_->damage.surface();
}

void Simulation::law_field(std::string_view name, std::vector<double>& values) const {
  whole().law_memory.field(name, values);
}

Particle Simulation::fastest(double& speed, bool& finite) const {
  BlockSet& blocks = state_->blocks;
  double largest = -1;
  Particle found = Body::no_particle, bad = Body::no_particle;
  const int components = blocks.model().degrees_of_freedom;
  blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        if (bad != Body::no_particle || !blocks.is_mine(block)) return;
        for (std::uint64_t n = 0; n < count; ++n) {
          double square = 0;
          for (int c = 0; c < components; ++c)
            square += block.velocity[c][place + n] * block.velocity[c][place + n];
          if (!std::isfinite(square)) {
            bad = first + n;
            return;
          }
          if (square > largest) {
            largest = square;
            found = first + n;
          }
        }
      });
  if (!blocks.ranks().is_alone()) agree_on_fastest(blocks.ranks(), largest, found, bad);
  finite = bad == Body::no_particle;
  speed = finite ? std::sqrt(largest) : std::numeric_limits<double>::quiet_NaN();
  return finite ? found : bad;
}

double Simulation::farthest() const {
  double largest = 0;
  BlockSet& blocks = state_->blocks;
  blocks.for_runs([&](const Block& block, std::uint64_t place, Particle, std::uint64_t count) {
    if (!blocks.is_mine(block)) return;
    for (std::uint64_t n = place; n < place + count; ++n)
      largest = std::max(largest, norm({block.displacement[0][n], block.displacement[1][n],
                                        block.displacement[2][n]}));
  });
  if (blocks.ranks().is_alone()) return largest;
  blocks.ranks().meet(Ranks::Meeting::state);
  std::array<std::int64_t, 1> bits{std::bit_cast<std::int64_t>(largest)};  // ordered as the numbers
  blocks.ranks().largest(bits);
  return std::bit_cast<double>(bits[0]);
}

std::uint64_t Simulation::hash() const {
  BlockSet& blocks = state_->blocks;
  constexpr std::uint64_t start = 14695981039346656037u;
  std::uint64_t hash = start;
  const auto add = [&](std::uint64_t bits) {
    hash = (hash ^ bits) * 1099511628211u;
  };  // FNV-1a, a word at a time
  const int components = blocks.model().degrees_of_freedom;
  std::uint64_t sum = 0;
  blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        if (!blocks.is_mine(block)) return;
        for (std::uint64_t n = 0; n < count; ++n) {
          hash = start;
          add(first + n);
          for (int c = 0; c < components; ++c) {
            add(std::bit_cast<std::uint64_t>(block.displacement[c][place + n]));
            add(std::bit_cast<std::uint64_t>(block.velocity[c][place + n]));
          }
          add(blocks.layout().alive_bits(block, place + n));
          sum += hash;
        }
      });
  blocks.ranks().meet(Ranks::Meeting::state);
  std::array<std::int64_t, 1> all{static_cast<std::int64_t>(sum)};
  blocks.ranks().sum(all);
  hash = start;  // of what every rank knows
  if (!state_->damage.empty())
    state_->damage.for_damaged([&](Particle particle, double damage, double rate) {
      add(particle);
      add(std::bit_cast<std::uint64_t>(damage));
      add(std::bit_cast<std::uint64_t>(rate));
    });
  state_->loads.for_memory([&](double number) { add(std::bit_cast<std::uint64_t>(number)); });
  return static_cast<std::uint64_t>(all[0]) + hash;
}

double Simulation::bytes() const { return state_->blocks.layout().state_bytes(); }
double Simulation::scratch_bytes() const { return state_->blocks.layout().scratch_bytes(); }

}  // namespace hyperlattice
