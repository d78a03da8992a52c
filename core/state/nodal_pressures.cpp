#include <state/nodal_pressures.hpp>

#include <algorithm>

namespace hyperlattice {

NodalPressures::NodalPressures(const BlockSet& blocks)
    : blocks_(blocks), volumes_(blocks.model().nodal_volumes.get()) {
  if (empty()) return;
  first_.resize(blocks.size());
  blocks.layout().for_stretches(
      [this](const Stretch& stretch) { first_[stretch.block] = stretch.first; });
  now_ = volumes_->state();
}

double NodalPressures::bytes(const NodalVolumes& volumes) {
  return static_cast<double>(volumes.tetrahedra().size() * sizeof(double) +
                             volumes.particles() *
                                 (sizeof(std::uint8_t) + sizeof(Vec3) + 2 * sizeof(double)));
}

/// Calls work(n) for all n below `size` on the threads of the run.
template <class Work>
void NodalPressures::for_pieces(std::size_t size, const Work& work) const {
  constexpr std::size_t piece = 1024;
  blocks_.team().for_each((size + piece - 1) / piece, [&](std::size_t number) {
    for (std::size_t n = number * piece; n < std::min(size, (number + 1) * piece); ++n) work(n);
  });
}

void NodalPressures::update() {
  blocks_.team().for_each(blocks_.size(), [&](std::size_t number) {
    const Block& block = blocks_[number];
    const Particle end =
        number + 1 < blocks_.size() ? first_[number + 1] : blocks_.model().body.particles;
    for (Particle p = first_[number]; p < end; ++p)
      for (int c = 0; c < 3; ++c) now_.moved[p][c] = block.displacement[c][p - first_[number]];
  });
  volumes_->evaluate(now_, [this](std::size_t size, const auto& work) { for_pieces(size, work); });
}

std::array<Vec3, 4> NodalPressures::forces(std::size_t tetrahedron) const {
  std::array<Vec3, 4> forces = volumes_->gradients(tetrahedron, now_.moved);
  const double pressure = volumes_->pressure(tetrahedron, now_.pressures);
  for (Vec3& force : forces) force = -pressure * force;
  return forces;
}

double NodalPressures::lose(Particle a, Particle b, double step) {
  double energy = 0;
  volumes_->for_ended_by(a, b, [&](std::uint32_t particle) {
    if (now_.ended[particle] != 0) return;
    now_.ended[particle] = 1;
    energy += energy_before(particle, step);
    now_.pressures[particle] = now_.energies[particle] = 0;
  });
  return energy;
}

/// Returns the energy of a particle, J, half-way between its states before and after the last step.
/// The last update was before the step.
double NodalPressures::energy_before(Particle particle, double step) const {
  const auto moved = [&](Particle p) {
    const auto [block, index] = blocks_.at(p);
    return step *
           Vec3{block->velocity[0][index], block->velocity[1][index], block->velocity[2][index]};
  };
  // Only the volume of this particle works: a quarter of each of its tetrahedra.
  double growth = 0;
  for (const Tetrahedra::Use use : volumes_->tetrahedra().of(particle)) {
    const Corners& corners = volumes_->tetrahedra()[use.tetrahedron];
    const std::array<Vec3, 4> gradients = volumes_->gradients(use.tetrahedron, now_.moved);
    for (std::size_t n = 0; n < 4; ++n) growth += 0.25 * dot(gradients[n], moved(corners[n]));
  }
  return now_.energies[particle] + 0.5 * now_.pressures[particle] * growth;
}

}  // namespace hyperlattice
