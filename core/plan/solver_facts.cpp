#include <host/plugin_call.hpp>
#include <model/local_limits.hpp>
#include <model/region_index.hpp>
#include <plan/solver_facts.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace hyperlattice {

SolverFacts solver_facts(const Model& model, double start_time) {
  const Site low = model.body.low, high = model.body.high;
  const double most = std::numeric_limits<std::int32_t>::max() - 1.0;
  const auto count = [most](double sites) {
    return 1 + static_cast<std::int32_t>(std::min(sites, most));
  };
  const auto sites = [](std::int32_t from, std::int32_t to) {
    return static_cast<double>(to) - from;
  };
  SolverFacts facts{
      start_time, model.step_limit.time_step, model.loads.corners,
      count(std::max({sites(low.i, high.i), sites(low.j, high.j), sites(low.k, high.k)}))};
  facts.listed = model.body.is_listed();
  facts.nodal_volumes = model.nodal_volumes != nullptr;
  if (facts.listed) {
    const Vec3 size = model.body.highest - model.body.lowest;
    facts.sites_across = count(std::max({size.x, size.y, size.z}) / model.body.grid.spacing);
  }
  facts.remembers = model.springs.memory > 0;
  facts.damages = !model.cohesive.empty();
  facts.answering = model.loads.answering;
  facts.breaks = model.springs.criteria;
  facts.self = &model;
  facts.divide = [](const void* self, std::int64_t parts, LocalSteps& steps,
                    const Complaint& why) noexcept {
    return PluginCall::answer(false, [&] {
      const auto& of = *static_cast<const Model*>(self);
      const std::string objection = objection_to_local_steps(of);
      if (!objection.empty()) return why.say("local_steps 1, or " + objection), false;
      steps = LocalLimits(of).divide(parts);
      return true;
    });
  };
  facts.find_middle = [](const void* self, RegionId region, Vec3& middle,
                         const Complaint& why) noexcept {
    return PluginCall::answer(false, [&] {
      const auto& of = *static_cast<const Model*>(self);
      RegionIndex regions(of.body, of.scene->regions);
      const std::span<const Particle> particles = regions.particles(region);
      if (particles.empty()) return why.say(regions.expected_particles(region)), false;
      middle = {};
      for (const Particle particle : particles) middle += of.body.position(particle);
      middle = middle / static_cast<double>(particles.size());
      return true;
    });
  };
  return facts;
}

}  // namespace hyperlattice
