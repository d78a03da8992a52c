#include <model/material.hpp>
#include <scene/stage_call.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

double Material::Criterion::alarm(const SpringFacts& spring) const {
  double alarm = 0;
  call(*stage, "alarm", [&](const Complaint& why) {
    return stage->functions<FailureFunctions>().alarm(component.get(), spring, alarm, why);
  });
  // Such a spring would never break, and nobody would notice.
  if (std::isnan(alarm))
    throw plugin_error(*stage, "alarm", "it gives an elongation that is no number (nan)");
  return std::max(alarm,
                  -spring.rest_length);  // no length is negative, so no elongation is below -L0
}

double Material::alarm(const SpringFacts& spring) const {
  double lowest = infinity;
  for (const Criterion& criterion : failures) lowest = std::min(lowest, criterion.alarm(spring));
  return lowest;
}

}  // namespace hyperlattice
