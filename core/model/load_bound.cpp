// Stable time step with loads that answer to the motion. On a particle of mass m the answer has at
// most the derivative c by displacement and d by velocity. Central differences, which use the
// velocity of half a step before, are stable while
//   M - dt D / 2 - dt^2 (K + C) / 4 > 0,
// and this holds if
//   1 > dt max(d / m) / 2 + dt^2 (omega_max^2 + max(c / m)) / 4.
// The reason: with the velocity of the step's middle in place of the one before, M - dt D / 2
// replaces the mass.
#include <model/build.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hyperlattice {

void limit_step_by_loads(Model& model) {
  std::map<Particle, LoadStiffnessBound> reactions;
  std::string names;
  for (const Load& load : model.loads) {
    bool reacts = false;
    for (const WatchedParticle& watched : load.watched) {
      if (watched.reaction.stiffness == 0 && watched.reaction.viscosity == 0) continue;
      LoadStiffnessBound& sum = reactions[watched.particle];
      sum.stiffness += watched.reaction.stiffness;
      sum.viscosity += watched.reaction.viscosity;
      reacts = true;
    }
    if (reacts)
      names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", load.stage->component->type(),
                           load.stage->pointer);
  }
  if (reactions.empty()) return;
  double stiffer = 0, rate = 0;  // 1/s2, 1/s
  for (const auto& [particle, reaction] : reactions) {
    stiffer = std::max(stiffer, reaction.stiffness / model.mass(particle));
    rate = std::max(rate, reaction.viscosity / model.mass(particle));
  }
  const double alone = model.step_limit.time_step, square = 4 / (alone * alone) + stiffer;
  model.step_limit.time_step = 2 / (0.5 * rate + std::sqrt(0.25 * rate * rate + square));
  model.step_limit.because += fmt::format(
      "; that alone allows {:.6g} s, but what {} answers shortens it to {:.3g} of "
      "that, a safe bound",
      alone, names, model.step_limit.time_step / alone);
}

}  // namespace hyperlattice
