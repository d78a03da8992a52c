#include <process/peak_memory.hpp>
#include <run/summary.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

namespace hyperlattice {

namespace {

nlohmann::json energy_json(const Plan& plan, const Outcome& outcome) {
  const EnergyBalance& b = outcome.last.balance;
  nlohmann::json energy = {{"kinetic", b.kinetic},
                           {"kinetic_mean", b.kinetic_mean},
                           {"stored", b.stored},
                           {"dissipated", b.dissipated()},
                           {"dissipated_failure", b.dissipated_failure},
                           {"dissipated_damping", b.dissipated_damping},
                           {"injected", b.injected},
                           {"error", b.error},
                           {"relative_error", b.relative_error()},
                           {"largest_relative_error", outcome.largest_relative_error}};
  auto& loads = energy["loads"] = nlohmann::json::array();
  for (std::size_t n = 0; n < outcome.injected_by_load.size() && n < plan.model->loads.size();
       ++n) {
    const Stage& stage = *plan.model->loads[n].stage;
    loads.push_back({{"type", stage.component->type()},
                     {"name", stage.name},
                     {"injected", outcome.injected_by_load[n]}});
  }
  return energy;
}

}  // namespace

nlohmann::json summary_json(const Plan& plan, const Outcome& outcome) {
  nlohmann::json summary = plan_json(plan);
  summary.erase("left_out");
  const double work =
      static_cast<double>(plan.model->body.particles) * static_cast<double>(outcome.steps);
  summary["identity"] = identity_json(plan.identity);
  summary["status"] = outcome.status;
  if (!outcome.reason.empty()) summary["reason"] = outcome.reason;
  summary["exit_code"] = outcome.exit_code;
  summary["planned_steps"] = summary["steps"];
  summary["planned_end_time"] = summary["end_time"];
  summary["steps"] = outcome.steps;
  summary["end_time"] = outcome.time;
  summary["wall_seconds"] = {{"setup", outcome.setup_seconds},
                             {"solve", outcome.solve_seconds},
                             {"output", outcome.output_seconds}};
  summary["nanoseconds_per_particle_step"] = work > 0 ? 1e9 * outcome.solve_seconds / work : 0.0;
  summary["peak_memory_bytes"] = peak_memory_bytes();
  if (outcome.peak_bytes.size() > 1) summary["peak_memory_bytes_of_ranks"] = outcome.peak_bytes;
  summary["energy"] = energy_json(plan, outcome);
  summary["broken_springs"] = {{"open", outcome.last.broken_open},
                               {"closed", outcome.last.broken_closed}};
  if (!plan.model->cohesive.empty())
    summary["cracks"] = {{"surface_energy", outcome.last.cracks.energy},
                         {"area", outcome.last.cracks.area}};
  if (outcome.rest) {
    auto& rest = summary["rest"] = {{"residual", outcome.rest->residual},
                                    {"iterations", outcome.rest->iterations}};
    if (outcome.rest->displacement_error >= 0)
      rest["displacement_error"] = outcome.rest->displacement_error;
  }
  for (const std::string& warning : outcome.warnings) summary["warnings"].push_back(warning);
  summary["state_hash"] = fmt::format("{:016x}", outcome.state_hash);
  return summary;
}

}  // namespace hyperlattice
