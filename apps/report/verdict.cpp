#include <base/figures.hpp>
#include <report/verdict.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::report {

namespace {

/// The largest values that the report calls fine. The tolerances of a run, at which it stops, may
/// be larger.
constexpr double fine_balance = 0.01;   ///< fraction of the largest energy
constexpr double fine_residual = 1e-3;  ///< fraction of the mean force on held or loaded particles
constexpr double fine_displacement = 0.01;

std::string seconds(double value) { return quantity_text(value, "s"); }

double number_in(const Json& json, const char* key, double otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
}

/// Returns the solver stages of the scene, in order.
std::vector<Json> solvers(const RunRecord& run) {
  std::vector<Json> found;
  if (run.scene.is_object() && run.scene.contains("pipeline"))
    for (const Json& stage : run.scene["pipeline"])
      if (stage.is_object() && word_in(stage, "type").starts_with("solvers."))
        found.push_back(stage);
  return found;
}

std::optional<double> last_of(const Columns& table, const char* name) {
  const auto* column = table.find(name);
  return column == nullptr || column->empty() ? std::nullopt
                                              : std::optional<double>(column->back());
}

double largest_of(const Columns& table, const char* name) {
  double largest = 0;
  if (const auto* column = table.find(name))
    for (const double value : *column) largest = std::max(largest, std::abs(value));
  return largest;
}

class RunExamination {
 public:
  explicit RunExamination(const RunRecord& run) : run_(run), solvers_(solvers(run)) {
    if (run.summary.is_object() && run.summary.contains("stages") &&
        run.summary["stages"].is_array())
      for (const Json& stage : run.summary["stages"])
        if (stage.is_object()) stages_.push_back(stage);
    all_at_rest_ = !stages_.empty() && std::all_of(stages_.begin(), stages_.end(), is_at_rest);
  }

  std::vector<Finding> findings() {
    if (const std::string reason = run_.word("/reason"); !reason.empty())
      add("reason", run_.status() == "failed" ? Judgement::wrong : Judgement::doubtful, reason, {});
    ask_progress();
    if (run_.has_checkpoint && run_.status() != "done")
      add("checkpoint", Judgement::plain,
          "Its checkpoint.bin is there, from which `hyperlattice run --resume` goes on.", {});
    for (const Json& stage : stages_) ask_time_step(stage);
    ask_rest();
    ask_energy();
    if (!all_at_rest_) ask_momentum();
    ask_breakage();
    if (run_.has_failing_motion)
      add("failing_motion", Judgement::doubtful,
          "A solver found no state of rest; failing_motion.csv says how the body moves.", {});
    if (run_.summary.contains("warnings") && run_.summary["warnings"].is_array())
      for (const Json& warning : run_.summary["warnings"])
        if (warning.is_string())
          add("warning", Judgement::doubtful, "Warning: " + warning.get<std::string>(), {});
    for (const std::string& note : run_.notes) add("note", Judgement::doubtful, note, {});
    return std::move(findings_);
  }

 private:
  static bool is_at_rest(const Json& stage) { return stage.value("at_rest", Json(false)) == true; }

  void add(std::string about, Judgement judgement, std::string sentence, Json numbers) {
    findings_.push_back({std::move(about), judgement, std::move(sentence),
                         numbers.is_null() ? Json::object() : std::move(numbers)});
  }

  /// Reports the progress of a run that has not ended.
  void ask_progress() {
    if (!run_.summary.is_null()) return;
    const auto time = last_of(run_.history, "time"), step = last_of(run_.history, "step");
    std::string sentence = "The run goes on, or was killed: it has left no summary.json.";
    Json numbers = Json::object();
    if (time && step) {
      const double end = solvers_.empty() ? 0 : number_in(solvers_.back(), "end_time", 0);
      sentence += fmt::format(" Its latest record is of step {} at {}{}.", count_text_of(*step),
                              seconds(*time), end > 0 ? " of " + seconds(end) : "");
      numbers = {{"time", *time}, {"step", *step}};
      if (end > 0) numbers["planned_end_time"] = end;
    }
    add("progress", Judgement::doubtful, sentence, numbers);
  }

  void ask_time_step(const Json& stage) {
    const double step = number_in(stage, "time_step", 0),
                 stable = number_in(stage, "stable_time_step", 0);
    if (!(step > 0) || !(stable > 0)) return;
    const double fraction = step / stable;
    const std::string because = run_.word("/critical_because");
    const double critical = run_.number("/critical_time_step").value_or(stable);
    add("time_step", fraction <= 1 ? Judgement::fine : Judgement::wrong,
        fmt::format("Time step ({}): at most {}, {} of the stable {}{}.", word_in(stage, "type"),
                    seconds(step), short_number(fraction, 3), seconds(stable),
                    because.empty() ? ""
                                    : fmt::format("; the critical step of the body is {}, by {}",
                                                  seconds(critical), because)),
        {{"stage", word_in(stage, "name")},
         {"time_step", step},
         {"stable_time_step", stable},
         {"critical_time_step", critical},
         {"share", fraction}});
  }

  void ask_rest() {
    const auto residual = run_.number("/rest/residual");
    if (!residual) return;
    Json numbers = {{"residual", *residual}};
    double tolerance = 0;
    for (std::size_t n = 0; n < stages_.size() && n < solvers_.size(); ++n)
      if (is_at_rest(stages_[n]))
        tolerance = number_in(solvers_[n], "tolerance", 0);  // the last one, as in the summary
    std::string sentence = fmt::format(
        "At rest: the largest force out of balance is {} of the mean force on held or loaded "
        "particles",
        short_number(*residual, 3));
    if (tolerance > 0) {
      sentence += fmt::format("; the solver's tolerance is {}", short_number(tolerance, 3));
      numbers["tolerance"] = tolerance;
    }
    if (const auto error = run_.number("/rest/displacement_error")) {
      sentence += fmt::format(". The displacements are right to about {}", percent_text(*error));
      numbers["displacement_error"] = *error;
    }
    if (const auto iterations = run_.number("/rest/iterations")) {
      sentence += fmt::format(" ({} iterations)", short_number(*iterations));
      numbers["iterations"] = *iterations;
    }
    const bool is_fine = *residual <= fine_residual &&
                         run_.number("/rest/displacement_error").value_or(0) <= fine_displacement &&
                         (tolerance == 0 || *residual <= tolerance);
    const bool has_error = numbers.contains("displacement_error");
    const std::string bounds =
        short_number(fine_residual, 3) +
        (has_error ? " and " + percent_text(fine_displacement) : std::string());
    if (is_fine)
      sentence += (has_error ? ". Both are below their bounds, " : ". It is below its bound, ");
    else
      sentence += (has_error ? ". Their bounds are " : ". Its bound is ");
    sentence += bounds;
    add("rest", is_fine ? Judgement::fine : Judgement::doubtful, sentence + ".", numbers);
  }

  /// Returns the smallest energy tolerance of the stages with time steps (static stages ignore it);
  /// 0 if there is none.
  double energy_tolerance() const {
    double strictest = 0;
    for (std::size_t n = 0; n < solvers_.size(); ++n) {
      const double tolerance = number_in(solvers_[n], "energy_tolerance", 0);
      const bool minds = n >= stages_.size() || !is_at_rest(stages_[n]);
      if (minds && tolerance > 0 && (strictest == 0 || tolerance < strictest))
        strictest = tolerance;
    }
    return strictest;
  }

  void ask_energy() {
    std::optional<double> at_end = run_.number("/energy/relative_error");
    if (!at_end) at_end = last_of(run_.history, "relative_error");
    if (!at_end) return;
    const double largest =
        std::max(std::abs(*at_end), run_.number("/energy/largest_relative_error")
                                        .value_or(largest_of(run_.history, "relative_error")));
    const double tolerance = energy_tolerance();
    std::string sentence =
        fmt::format("Energy balance: off by {} of the largest energy {}, by {} at most",
                    percent_text(std::abs(*at_end)), now_, percent_text(largest));
    sentence +=
        all_at_rest_
            ? "; along states of rest it is a measure of how finely the loads were stepped."
        : tolerance > 0
            ? fmt::format("; fine is at most {}, and the run stops at {}.",
                          percent_text(fine_balance), percent_text(tolerance))
            : fmt::format(
                  "; fine is at most {}, and the scene sets no tolerance at which the run stops.",
                  percent_text(fine_balance));
    Json numbers = {{"relative_error", *at_end}, {"largest_relative_error", largest}};
    if (tolerance > 0) numbers["energy_tolerance"] = tolerance;
    const Judgement judgement = all_at_rest_                               ? Judgement::plain
                                : tolerance > 0 && largest > tolerance     ? Judgement::wrong
                                : tolerance > 0 && largest <= fine_balance ? Judgement::fine
                                                                           : Judgement::doubtful;
    add("energy_balance", judgement, sentence, numbers);
  }

  void ask_momentum() {
    const auto x = last_of(run_.history, "momentum_x"), y = last_of(run_.history, "momentum_y"),
               z = last_of(run_.history, "momentum_z");
    if (!x || !y || !z) return;
    double largest = 0;
    for (std::size_t n = 0; n < run_.history.rows(); ++n)
      largest = std::max(largest, std::hypot((*run_.history.find("momentum_x"))[n],
                                             (*run_.history.find("momentum_y"))[n],
                                             (*run_.history.find("momentum_z"))[n]));
    const double size = std::hypot(*x, *y, *z);
    add("momentum", Judgement::plain,
        fmt::format(
            "Momentum: {} N s {}, at most {} N s. Only loads, supports and damping can change it.",
            short_number(size, 3), now_, short_number(largest, 3)),
        {{"at_end", {*x, *y, *z}}, {"largest", largest}});
  }

  void ask_breakage() {
    std::optional<double> open = run_.number("/broken_springs/open"),
                          closed = run_.number("/broken_springs/closed");
    if (!open || !closed) {
      open = last_of(run_.history, "broken_open");
      closed = last_of(run_.history, "broken_closed");
    }
    if (!open || !closed) return;
    const double broken = *open + *closed;
    Json numbers = {{"open", *open}, {"closed", *closed}};
    if (broken == 0) {
      const bool unbreakable =
          run_.summary.is_object() && run_.summary.value("breakable", Json()) == false;
      return add("broken_springs", Judgement::plain,
                 unbreakable ? "No spring of this scene can break." : "No spring broke.", numbers);
    }
    const auto springs = run_.number("/springs");
    std::string sentence = fmt::format(
        "Broken springs: {}{}, {} open and {} closed", count_text_of(broken),
        springs && *springs > 0
            ? fmt::format(" of {} ({})", count_text_of(*springs), percent_text(broken / *springs))
            : "",
        count_text_of(*open), count_text_of(*closed));
    if (run_.first_break) {
      sentence += fmt::format("; the first broke at {}", seconds(*run_.first_break));
      numbers["first_time"] = *run_.first_break;
    }
    add("broken_springs", Judgement::plain, sentence + ".", numbers);
  }

  const RunRecord& run_;
  std::vector<Json> solvers_, stages_;
  bool all_at_rest_ = false;
  const char* now_ = run_.summary.is_null() ? "at the latest record" : "at the end";
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> verdict(const RunRecord& run) { return RunExamination(run).findings(); }

}  // namespace hyperlattice::report
