// From one state of rest to the next: takes over the result of a static solver and continues the
// energy balance of the steps in time. Only the ends of the path are known; its work is the mean of
// the forces at both ends times the displacement between them.
#include <state/parts.hpp>

#include <algorithm>

namespace hyperlattice {

void Simulation::hold_time(double time) {
  if (std::exchange(parts_->time_held, true)) return;
  for (Block& block : parts_->blocks)
    for (Contribution& part : block.contributions) {
      if (part.driven == 0) continue;
      const double way = parts_->model.loads[part.load].integral(parts_->time, time);
      const std::uint64_t index = block.boundary_particles[part.support].index;
      for (int c = 0; c < 3; ++c)
        set_component(part.goal, c,
                      block.displacement[c][index] + way * component(part.velocity, c));
    }
  set_time(time);
}
void Simulation::release_time() { parts_->time_held = false; }

void Simulation::alive(std::vector<std::uint16_t>& bits) const {
  bits.resize(parts_->model.body.particles);
  parts_->for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        std::copy_n(block.alive.get() + place, count,
                    bits.begin() + static_cast<std::ptrdiff_t>(first));
      });
}

double Simulation::kinetic() const {
  std::vector<double>& masses = parts_->particle_masses;
  const Model& model = parts_->model;
  if (masses.empty())
    for (Particle particle = 0; particle < model.body.particles; ++particle)
      masses.push_back(model.mass(particle));
  struct Piece {
    const Block* block;
    std::uint64_t place, count;
    Particle first;
    double twice;
  };
  // The same pieces for any number of blocks, because blocks are cut between rows.
  std::vector<Piece> pieces;
  parts_->for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        for (std::uint64_t n = 0; n < count; n += Listed::stretch)
          pieces.push_back({&block, place + n, std::min<std::uint64_t>(Listed::stretch, count - n),
                            first + n, 0});
      });
  parts_->team.for_each(pieces.size(), [&](std::size_t number) {
    Piece& piece = pieces[number];
    for (std::uint64_t n = 0; n < piece.count; ++n) {
      double square = 0;
      for (int c = 0; c < model.degrees_of_freedom; ++c) {
        const double velocity = piece.block->velocity[c][piece.place + n];
        square += velocity * velocity;
      }
      piece.twice += masses[piece.first + n] * square;
    }
  });
  double twice = 0;
  for (const Piece& piece : pieces) twice += piece.twice;
  return twice / 2;
}

void Simulation::halt() {
  const double error = parts_->balance().error;
  for (const Block& block : parts_->blocks)
    for (int c = 0; c < parts_->model.degrees_of_freedom; ++c) block.velocity[c].clear();
  parts_->last_step = 0;  // the next step starts from rest
  parts_->halted_energy += error - parts_->balance().error;
}

void Simulation::reset_energy_balance() { parts_->start_energy += parts_->balance().error; }

void Simulation::apply_equilibrium(const EquilibriumUpdate& to) {
  halt();
  const Model& model = parts_->model;
  const auto moved_of = [&](const Block& block, const BoundaryParticle& support,
                            Particle particle) {
    const auto way = [&](std::size_t c) {
      return to.xyz[3 * particle + c] - block.displacement[c][support.index];
    };
    return Vec3{way(0), way(1), way(2)};
  };
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const double mean = 0.5 * (to.factor_before[l] + to.factor[l]);
    for (Block& block : parts_->blocks)
      for (Contribution& part : block.contributions) {
        if (part.load != l) continue;
        BoundaryParticle& support = block.boundary_particles[part.support];
        const Particle particle = part.particle;
        const Vec3 moved = moved_of(block, support, particle);
        part.work += mean * dot(part.force, moved);
        part.held_work += mean * dot(part.force, along(support.axes, moved));
        for (int c = 0; c < 3; ++c) {
          const std::size_t n = 3 * particle + static_cast<std::size_t>(c);
          if (((part.displaced | part.driven) >> c & 1u) != 0)
            support.reaction_work -= 0.5 * (to.force[n] + to.force_before[n]) * component(moved, c);
        }
      }
  }
  if (!(model.acceleration == Vec3{})) {
    const double unused = 1 - 0.5 * (to.gravity_before + to.gravity);
    std::vector<double> before;
    displacements(before);
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 moved{to.xyz[3 * p] - before[3 * p], to.xyz[3 * p + 1] - before[3 * p + 1],
                       to.xyz[3 * p + 2] - before[3 * p + 2]};
      parts_->gravity_unused += unused * model.mass(p) * dot(model.acceleration, moved);
    }
  }
  parts_->halted_energy += to.dissipated;
  parts_->advance_laws(to);
  set({false, 0, 3}, to.xyz);
  if (!to.heights.empty()) set({false, 3, 1}, to.heights);
  // Known since halt(); the work on the way from there is in the balance.
  parts_->start_known = true;
  set_time(to.time);
  parts_->advanced = 0;  // failure criteria know no times between the states of rest
  ++parts_->steps;
}

}  // namespace hyperlattice
