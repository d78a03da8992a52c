#include <model/load.hpp>
#include <scene/stage_call.hpp>

#include <algorithm>
#include <numeric>

namespace hyperlattice {

double Load::factor(double time) const {
  double factor = 0;
  call(*stage, "factor", [&](const Complaint& why) {
    return stage->functions<LoadFunctions>().factor(component.get(), time, factor, why);
  });
  return factor;
}

void Load::prepare(const WatchedMotion& motion) const {
  call(*stage, "prepare", [&](const Complaint& why) {
    return stage->functions<LoadFunctions>().prepare(component.get(), motion, why);
  });
}

void Load::update(const WatchedMotion& motion, std::span<double> kept) const {
  call(*stage, "update", [&](const Complaint& why) {
    return stage->functions<LoadFunctions>().update(component.get(), motion, kept, why);
  });
}

Vec3 Load::answer(const WatchedMotion& motion, std::size_t n) const {
  Vec3 force;
  call(*stage, "answer", [&](const Complaint& why) {
    return stage->functions<LoadFunctions>().answer(component.get(), motion, n, force, why);
  });
  return force;
}

std::vector<Particle> Load::acts_on(std::uint64_t all) const {
  std::vector<Particle> found;
  if (!(acceleration == Vec3{})) {
    found.resize(all);
    std::iota(found.begin(), found.end(), Particle{0});
    return found;
  }
  for (const LoadedParticle& loaded : particles) found.push_back(loaded.particle);
  for (const WatchedParticle& seen : watched)
    if (seen.answered) found.push_back(seen.particle);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace hyperlattice
