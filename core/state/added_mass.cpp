#include <state/added_mass.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// The drag of local damping along one component, as kernels have it, N.
double drag_of(double damping, double force, double velocity) {
  return velocity == 0 ? 0 : std::copysign(damping * force, velocity);
}

/// Sets the ranges of the rows in an array of boundary particles in the order of the rows.
void set_ranges(std::vector<Row>& rows, const std::vector<BoundaryParticle>& all) {
  std::uint32_t next = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].first_boundary_particle = next;
    while (next < all.size() && all[next].row == static_cast<std::int32_t>(r)) ++next;
    rows[r].last_boundary_particle = next;
  }
}

}  // namespace

void AddedMass::start(double time_step) {
  if (!empty())
    for (Block& block : blocks_) put_back(block);
  time_step_ = time_step;
  particles_.clear();
  of_blocks_.clear();
  if (!(time_step > 0)) return;
  particles_ = MassScaling(blocks_.model(), time_step).particles();
  if (particles_.empty()) return;
  of_blocks_.resize(blocks_.size());
  for (Block& block : blocks_) arrange(block);
}

/// Gives the block its own boundary particles again.
void AddedMass::put_back(Block& block) const {
  for (const Heavy& heavy : of_blocks_[block.number].heavy)
    if (heavy.support != no_support) block.boundary_particles[heavy.support].mass = heavy.own;
  set_ranges(block.rows, block.boundary_particles);
}

double AddedMass::of(Particle particle) const {
  const auto found = std::lower_bound(
      particles_.begin(), particles_.end(), particle,
      [](const MassScaling::Heavy& heavy, Particle p) { return heavy.particle < p; });
  return found != particles_.end() && found->particle == particle ? found->added : 0;
}

/// Merges the particles with added mass into the block's boundary particles. Both are in the order
/// of the particles, which is that of the rows.
void AddedMass::arrange(Block& block) {
  OfBlock& of = of_blocks_[block.number];
  std::vector<BoundaryParticle>& supports = block.boundary_particles;
  std::uint32_t next = 0;  // of the supports
  const auto take_support = [&] {
    of.places.push_back(static_cast<std::uint32_t>(of.all.size()));
    of.all.push_back(supports[next++]);
  };
  for (const MassScaling::Heavy& heavy : particles_) {
    const Place place = blocks_.layout().place(heavy.particle);
    if (place.block != block.number) continue;
    while (next < supports.size() && supports[next].index < place.index) take_support();
    const double own = blocks_.model().mass(heavy.particle), whole = own + heavy.added;
    const bool is_support = next < supports.size() && supports[next].index == place.index;
    of.heavy.push_back(
        {static_cast<std::uint32_t>(of.all.size()), is_support ? next : no_support, own, whole});
    if (is_support) {
      supports[next].mass = whole;
      take_support();
      continue;
    }
    BoundaryParticle& added = of.all.emplace_back();
    added.index = place.index;
    added.row = static_cast<std::int32_t>(place.row);
    added.site = place.site;
    added.mass = whole;
  }
  while (next < supports.size()) take_support();
  set_ranges(block.rows, of.all);
}

BoundaryParticle* AddedMass::before_kernel(const Block& block) {
  OfBlock& of = of_blocks_[block.number];
  for (std::size_t n = 0; n < of.places.size(); ++n)
    of.all[of.places[n]] = block.boundary_particles[n];
  return of.all.data();
}

void AddedMass::return_supports(Block& block) const {
  const OfBlock& of = of_blocks_[block.number];
  for (std::size_t n = 0; n < of.places.size(); ++n)
    block.boundary_particles[n] = of.all[of.places[n]];
}

void AddedMass::after_step(Block& block, double back, double forward, double damping) {
  OfBlock& of = of_blocks_[block.number];
  const double duration = back + forward;
  for (const Heavy& heavy : of.heavy) {
    BoundaryParticle& particle = of.all[heavy.place];
    for (int c = 0; c < 3; ++c) {
      const double before = particle.speed_before[c],
                   drag = drag_of(damping, particle.sum[c], before),
                   impulse = duration * (particle.sum[c] - drag),
                   light = before + impulse / heavy.own, after = before + impulse / heavy.whole;
      block.damped_work[static_cast<std::size_t>(particle.row)] += forward * drag * (after - light);
      if ((particle.axes >> c & 1U) != 0) continue;
      block.velocity[c].set(particle.index, after);
      block.displacement[c].set(particle.index, particle.place_before[c] + 2 * forward * after);
      particle.path[c] = back * before + forward * after;
    }
  }
  return_supports(block);
}

// The kernel counts v+ = v + I / m in place of v + I / (m + a), with the impulse I of the kick: in
// 1/2 m v v+, in the momentum m (v + v+) / 2 and in 1/2 m ((v + v+) / 2)^2.
void AddedMass::after_measurement(Block& block, double kick, double damping) {
  const OfBlock& of = of_blocks_[block.number];
  for (const Heavy& heavy : of.heavy) {
    const BoundaryParticle& particle = of.all[heavy.place];
    RowSums& sums = block.sums[static_cast<std::size_t>(particle.row)];
    const double added = heavy.whole - heavy.own;
    for (int c = 0; c < 3; ++c) {
      const double v = particle.speed_before[c],
                   impulse = kick * (particle.sum[c] - drag_of(damping, particle.sum[c], v));
      sums.kinetic += 0.5 * added * v * v;
      sums.kinetic_mean +=
          0.5 * added * v * v + 0.125 * impulse * impulse * (1 / heavy.whole - 1 / heavy.own);
      sums.momentum[c] += added * v;
    }
  }
  return_supports(block);
}

void AddedMass::kick(double duration, double sign, double damping) {
  for (std::size_t b = 0; b < of_blocks_.size(); ++b)
    for (const Heavy& heavy : of_blocks_[b].heavy) {
      const BoundaryParticle& particle = of_blocks_[b].all[heavy.place];
      for (int c = 0; c < 3; ++c) {
        if ((particle.axes >> c & 1U) != 0) continue;
        const double v = particle.speed_before[c],
                     force = particle.sum[c] - drag_of(damping, particle.sum[c], v);
        blocks_[b].velocity[c].set(particle.index,
                                   v + sign * duration * force * (1 / heavy.own - 1 / heavy.whole));
      }
    }
}

void AddedMass::archive(Archive& archive) {
  double time_step = time_step_;
  archive(time_step);
  if (archive.restores()) start(time_step);
}

}  // namespace hyperlattice
