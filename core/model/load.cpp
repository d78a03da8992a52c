#include <model/load.hpp>
#include <scene/stage_call.hpp>

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

Vec3 Load::answer(const WatchedMotion& motion, std::size_t n) const {
  Vec3 force;
  call(*stage, "answer", [&](const Complaint& why) {
    return stage->functions<LoadFunctions>().answer(component.get(), motion, n, force, why);
  });
  return force;
}

}  // namespace hyperlattice
