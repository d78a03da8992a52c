// Loads that vary from particle to particle, for comparison with closed forms. A scene gives all
// particles of a load one value; here a function of their place gives each its own.
#pragma once

#include <plan/plan.hpp>

#include <stdexcept>
#include <string>

namespace hyperlattice::test {

/// Returns the load of this name.
inline Load& load_named(Plan& plan, const std::string& name) {
  for (Load& load : plan.model->loads.all)
    if (load.stage->name == name) return load;
  throw std::out_of_range("no load " + name);
}

/// Replaces the displacement, m, that the load prescribes, by displacement(x) for the particle at
/// x, m.
template <class Displacement>
void prescribe(Plan& plan, const std::string& load, const Displacement& displacement) {
  for (LoadedParticle& loaded : load_named(plan, load).particles)
    loaded.displacement = displacement(plan.model->body.position(loaded.particle));
}

/// Replaces the force, N, of the load by force(x) for the particle at x, m.
template <class ForceAt>
void push(Plan& plan, const std::string& load, const ForceAt& force) {
  for (LoadedParticle& loaded : load_named(plan, load).particles)
    loaded.force = force(plan.model->body.position(loaded.particle));
}

}  // namespace hyperlattice::test
