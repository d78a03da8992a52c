// The public functions of Simulation.
#include <state/parts.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace hyperlattice {

Simulation::Simulation(const Model& model, int threads)
    : parts_(std::make_unique<Parts>(model, threads)) {}
Simulation::~Simulation() = default;

void Simulation::set_damping(double alpha, double rate) {
  parts_->damping = alpha;
  parts_->damping_rate = rate;
}
void Simulation::step(double time_step) { parts_->step(time_step); }
void Simulation::set_time(double time) {
  parts_->time = time;
  parts_->time_rest = 0;
}
double Simulation::time() const { return parts_->time; }
std::uint64_t Simulation::steps() const { return parts_->steps; }
EnergyBalance Simulation::balance() { return parts_->balance(); }

std::vector<double> Simulation::injected_by_load() {
  const RowSums sums = parts_->measure_now();
  return parts_->work_by_load(sums.potential - parts_->start_potential);
}

std::vector<Vec3> Simulation::force_on_load() {
  parts_->measure_now();
  std::vector<Vec3> forces(parts_->model.loads.size());
  for (const Block& block : parts_->blocks)
    for (const Contribution& part : block.contributions) {
      const double* sum = block.boundary_particles[part.support].sum;
      const Vec3 force = Vec3{sum[0], sum[1], sum[2]} + block.held_force[part.support];
      forces[part.load] = forces[part.load] + along(part.displaced | part.driven, force);
    }
  return forces;
}

const std::vector<Breakage>& Simulation::breakages() const { return parts_->breakages; }
double Simulation::elongation_now(std::size_t breakage) const {
  return parts_->elongation_now(breakage);
}

std::uint64_t Simulation::broken_open() const {
  constexpr std::size_t piece = 1024;  // breakages
  const std::size_t all = parts_->breakages.size();
  std::atomic<std::uint64_t> open = 0;
  parts_->team.for_each((all + piece - 1) / piece, [&](std::size_t number) {
    std::uint64_t here = 0;
    for (std::size_t n = number * piece; n < std::min(all, (number + 1) * piece); ++n)
      here += elongation_now(n) > 0 ? 1 : 0;
    open += here;
  });
  return open;
}

void Simulation::copy(const Quantity& quantity, std::vector<double>& values) const {
  copy(quantity, 0, parts_->model.body.particles, values);
}

void Simulation::copy(const Quantity& quantity, Particle first, std::uint64_t count,
                      std::vector<double>& values) const {
  const auto components = static_cast<std::size_t>(quantity.components);
  values.resize(count * components);
  parts_->for_runs(
      [&](const Block& block, std::uint64_t place, Particle start, std::uint64_t length) {
        const Particle from = std::max(start, first), to = std::min(start + length, first + count);
        if (from >= to) return;
        for (std::size_t c = 0; c < components; ++c) {
          const Numbers& numbers =
              (quantity.velocity ? block.velocity
                                 : block.displacement)[quantity.first + static_cast<int>(c)];
          for (Particle n = from; n < to; ++n)
            values[(n - first) * components + c] = numbers[place + (n - start)];
        }
      });
}

void Simulation::set(const Quantity& quantity, const std::vector<double>& values) {
  const auto components = static_cast<std::size_t>(quantity.components);
  parts_->for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        for (std::size_t c = 0; c < components; ++c) {
          const Numbers& to =
              (quantity.velocity ? block.velocity
                                 : block.displacement)[quantity.first + static_cast<int>(c)];
          for (std::uint64_t n = 0; n < count; ++n)
            to.set(place + n, values[(first + n) * components + c]);
        }
      });
  parts_->start_known = false;
}

void Simulation::displacements(std::vector<double>& xyz) const { copy({false, 0, 3}, xyz); }
void Simulation::displacements(std::vector<double>& xyz, Particle first,
                               std::uint64_t count) const {
  copy({false, 0, 3}, first, count, xyz);
}
void Simulation::velocities(std::vector<double>& xyz) const { copy({true, 0, 3}, xyz); }
void Simulation::heights(std::vector<double>& values) const {
  values.clear();
  if (parts_->model.degrees_of_freedom == 4) copy({false, 3, 1}, values);
}
void Simulation::height_rates(std::vector<double>& values) const {
  values.clear();
  if (parts_->model.degrees_of_freedom == 4) copy({true, 3, 1}, values);
}
void Simulation::set_displacements(const std::vector<double>& xyz,
                                   const std::vector<double>& heights) {
  set({false, 0, 3}, xyz);
  if (!heights.empty()) set({false, 3, 1}, heights);
}
void Simulation::set_velocities(const std::vector<double>& xyz,
                                const std::vector<double>& height_rates) {
  set({true, 0, 3}, xyz);
  if (!height_rates.empty()) set({true, 3, 1}, height_rates);
}

Particle Simulation::fastest(double& speed, bool& finite) const {
  double largest = -1;
  Particle found = 0;
  finite = true;
  parts_->for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        if (!finite) return;
        for (std::uint64_t n = 0; n < count; ++n) {
          double square = 0;
          for (int c = 0; c < parts_->model.degrees_of_freedom; ++c)
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
  parts_->for_runs([&](const Block& block, std::uint64_t place, Particle, std::uint64_t count) {
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
  parts_->for_runs([&](const Block& block, std::uint64_t place, Particle, std::uint64_t count) {
    for (std::uint64_t n = place; n < place + count; ++n) {
      for (int c = 0; c < parts_->model.degrees_of_freedom; ++c) {
        add(std::bit_cast<std::uint64_t>(block.displacement[c][n]));
        add(std::bit_cast<std::uint64_t>(block.velocity[c][n]));
      }
      add(parts_->layout->alive_bits(block, n));
    }
  });
  return hash;
}

double Simulation::bytes() const { return parts_->layout->state_bytes(); }
double Simulation::scratch_bytes() const { return parts_->layout->scratch_bytes(); }

}  // namespace hyperlattice
