#include <engine/momentum_watch.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

MomentumWatch::MomentumWatch(const Model& model)
    : model_(model), watches_(model.springs.choice.precision == Precision::doubles) {
  for (const Load& load : model.loads) {
    Vec3& force = force_.emplace_back();
    double& gross = force_gross_.emplace_back();
    if (!load.watched.empty()) watches_ = false;
    for (const LoadedParticle& loaded : load.particles) {
      if (loaded.displaced != 0 || loaded.driven != 0) watches_ = false;
      force += loaded.force;
      gross += norm(loaded.force);
    }
  }
  for (Particle p = 0; watches_ && p < model.body.particles; ++p) mass_ += model.mass(p);
}

double MomentumWatch::error_of(const EnergyBalance& balance, double time) {
  if (!watches_) return 0;
  if (now_.known == 0 || balance.interventions != now_.interventions) {
    now_ = {time, balance.momentum, 0, balance.interventions, 1};
    return 0;
  }
  for (std::size_t l = 0; l < force_.size(); ++l) {
    if (force_gross_[l] == 0) continue;
    const double integral = model_.loads[l].integral(now_.time, time);
    now_.expected += integral * force_[l];
    now_.gross += std::abs(integral) * force_gross_[l];
  }
  const Vec3 gained = mass_ * (time - now_.time) * model_.loads.acceleration;
  now_.expected += gained;
  now_.gross += norm(gained);
  now_.time = time;
  const double scale = std::max(now_.gross, std::sqrt(2 * mass_ * balance.scale));
  return scale > 0 ? norm(balance.momentum - now_.expected) / scale : 0;
}

}  // namespace hyperlattice
