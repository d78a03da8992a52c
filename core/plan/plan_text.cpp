// The plan as text for people. Every number comes from the JSON form, so that the two agree.
#include <base/figures.hpp>
#include <plan/added_mass.hpp>
#include <plan/damage.hpp>
#include <plan/estimates.hpp>
#include <plan/text_page.hpp>
#include <state/failure_record.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>

namespace hyperlattice {

namespace {

std::string duration_text(double seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 120) return fmt::format("about {:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("about {:.0f} min", seconds / 60);
  return fmt::format("about {:.1f} h", seconds / 3600);
}

std::string stage_text(const PlannedStage& stage) {
  const SolverPlan& plan = stage.plan;
  const std::string damped =
      plan.damping > 0 ? fmt::format(", local damping {:g}", plan.damping) : "";
  if (plan.at_rest && plan.time_step == 0)
    return fmt::format("to rest under the loads of {:.6g} s, in {} step{} of load", plan.end_time,
                       count_text(plan.steps), plan.steps == 1 ? "" : "s");
  const std::string of_stable =
      std::isfinite(plan.stable_time_step)
          ? fmt::format(", {:.3g} of the stable {:.6g} s", plan.time_step / plan.stable_time_step,
                        plan.stable_time_step)
          : ", stable for any length";
  const std::string local =
      plan.local.parts > 1
          ? fmt::format("; {:.3g}% of the particles are stiff and take {} steps within each",
                        100 * plan.local.share,
                        count_text(static_cast<std::uint64_t>(plan.local.parts)))
          : "";
  const std::string steps =
      fmt::format("steps of at most {:.6g} s{}{}{}", plan.time_step, of_stable, damped, local);
  if (plan.at_rest)
    return fmt::format("to rest under the loads of {:.6g} s, in about {} {}", plan.end_time,
                       count_text(plan.steps), steps);
  return fmt::format("{:.6g} s to {:.6g} s in {} {}", stage.start_time, plan.end_time,
                     count_text(plan.steps), steps);
}

std::string run_time_text(const Plan& plan) {
  const double most = plan.expected_seconds * slowest(*plan.model);
  if (duration_text(most) == duration_text(plan.expected_seconds)) return duration_text(most);
  return fmt::format("{} as long as nothing {}, up to {}", duration_text(plan.expected_seconds),
                     plan.model->springs.breakable && plan.model->loads.answering
                         ? "breaks or touches"
                     : plan.model->springs.breakable ? "breaks"
                                                     : "touches",
                     duration_text(most));
}

}  // namespace

std::string plan_text(const Plan& plan) {
  const nlohmann::json facts = plan_json(plan);
  const auto number = [&](const char* key) { return facts.at(key).get<double>(); };
  const auto count = [&](const char* key) {
    return count_text(facts.at(key).get<std::uint64_t>());
  };
  const auto word = [&](const char* key) { return facts.at(key).get<std::string>(); };

  Page page;
  page.title(plan.scene->title.empty() ? plan.scene->file.string() : plan.scene->title);

  page.section("Loaded");
  for (const auto& plugin : facts.at("plugins"))
    page.line(plugin.at("name").get<std::string>(),
              fmt::format("{}  {}", plugin.at("version").get<std::string>(),
                          plugin.at("path").get<std::string>()));

  page.section("Body");
  for (const auto& [name, value] : body_lines(plan.body)) page.line(name, value);

  page.section("Allocated");
  page.line("particles", count("particles"));
  page.line("state", fmt::format("{:.1f} bytes per particle", number("bytes_per_particle")));
  page.line("memory", bytes_text(number("memory_bytes")) +
                          (facts.at("breakable").get<bool>()
                               ? fmt::format(", and {} bytes for each spring that breaks",
                                             FailureRecord::bytes_each)
                               : ""));

  page.section("Computed");
  page.line("springs", fmt::format("{}, {:.2f} per particle", count("springs"),
                                   number("springs_per_particle")));
  if (facts.contains("springs_of_a_particle")) {
    const nlohmann::json& of = facts.at("springs_of_a_particle");
    const auto swinging = of.at("fewer_than_three").get<std::uint64_t>();
    page.line(
        "springs of a particle",
        fmt::format(
            "{} to {}{}", of.at("fewest").get<std::uint64_t>(), of.at("most").get<std::uint64_t>(),
            swinging == 0
                ? ""
                : fmt::format("; {} have fewer than three, and swing where a load reaches them",
                              count_text(swinging))));
  }
  page.line(
      "kernel",
      fmt::format(
          "{} degrees of freedom, membrane {}, {}{}, {} precision, {} instructions, {} thread{}",
          facts.at("degrees_of_freedom").get<int>(), word("membrane"),
          facts.at("volumetric").get<bool>() ? "volumetric energy, " : "",
          facts.at("breakable").get<bool>() ? "breakable" : "unbreakable", word("precision"),
          word("instructions"), plan.threads, plan.threads == 1 ? "" : "s"));
  if (facts.contains("damage"))
    for (const auto& entry : facts.at("damage"))
      for (const auto& [name, value] : damage_lines(entry)) page.line(name, value);
  page.line("critical time step",
            fmt::format("{:.6g} s: {}", number("critical_time_step"), word("critical_because")));
  if (plan.start)
    page.line("start", fmt::format("the state at {:.6g} s, step {}, of {}", plan.start->time,
                                   count_text(plan.start->steps), plan.start->file.string()));
  for (const PlannedStage& stage : plan.stages) {
    page.line(stage.stage->component->type(), stage_text(stage));
    if (stage.mass_scaling)
      page.line("added mass", added_mass_text(*stage.mass_scaling, *plan.model));
  }
  page.line("steps", count("steps"));
  page.line("output", fmt::format("about {}", bytes_text(number("output_bytes"))));
  page.line("run time", run_time_text(plan));

  if (!plan.model->warnings.empty()) page.section("Warnings");
  for (const std::string& warning : plan.model->warnings) page.line("warning", warning);

  page.section("Left out");
  for (const LeftOut& left : plan.left_out) page.line(left.what, left.why);
  return page.take();
}

}  // namespace hyperlattice
