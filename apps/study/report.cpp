#include <study/report.hpp>
#include <study/sweep.hpp>
#include <study/text_table.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace hyperlattice::study {

namespace {

std::string percent(double fraction) { return fmt::format("{:.3g} %", 100 * fraction); }

/// Appends the values of the axes as keys of an object.
void append_choice(Json& json, const std::vector<Axis>& axes, const Choice& choice,
                   std::size_t except) {
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (a == except) continue;
    const Json& value = axes[a].values[choice[a]].front();
    json[axes[a].name] = value.is_number() ? value : Json(axes[a].labels[choice[a]]);
  }
}

std::size_t refinement_of(const Study& study) {
  return study.refinement.value_or(study.axes.size());
}

Json row_json(const Study& study, const Row& row, bool pareto) {
  Json json;
  append_choice(json, study.axes, row.choice, study.axes.size());
  json["error"] = row.error ? Json(*row.error) : Json(nullptr);
  json["seconds"] = row.solve_seconds.empty() ? Json(nullptr) : Json(row.seconds());
  json["particles"] = row.particles;
  json["steps"] = row.steps;
  if (study.refinement) json["size"] = row.numbers[*study.refinement].value_or(0);
  json["pareto"] = pareto;
  if (study.is_sweep()) json["values"] = values_json(study, row);
  json["errors"] = Json::object();
  for (std::size_t c = 0; c < row.errors.size(); ++c)
    json["errors"][study.comparisons[c].name] = row.errors[c];
  json["setup_seconds"] = row.setup_seconds;
  json["repeats"] = row.solve_seconds;
  json["run"] = "runs/" + row.run;
  json["identity"] = row.identity;
  json["status"] = row.status;
  if (!row.reason.empty()) json["reason"] = row.reason;
  return json;
}

/// Returns a choice of all axes but the refinement.
Json choice_json(const Study& study, const Choice& choice) {
  Json json = Json::object();
  append_choice(json, study.axes, choice, refinement_of(study));
  return json;
}

Json order_json(const Study& study, const ChoiceOrder& order) {
  Json json = choice_json(study, order.choice);
  json["order"] = order.observed.order;
  if (!order.observed.doubt.empty()) json["doubt"] = order.observed.doubt;
  json["pairs"] = Json::array();
  const auto& errors = order.observed.errors;
  for (std::size_t n = 1; n < errors.size(); ++n)
    json["pairs"].push_back({{"from", errors[n - 1].size},
                             {"to", errors[n].size},
                             {"order", order.observed.pairs[n - 1]}});
  return json;
}

std::string table_text(const Study& study, const std::vector<Row>& rows, const Findings& findings) {
  Lines lines(1);
  for (const Axis& axis : study.axes) lines[0].push_back(shown_whole(axis.name));
  for (const char* name : {"particles", "steps", "error", "seconds", ""})
    lines[0].emplace_back(name);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    auto& line = lines.emplace_back();
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      line.push_back(shown_whole(study.axes[a].labels[row.choice[a]]));
    line.push_back(row.is_done() ? fmt::format("{}", row.particles) : "");
    line.push_back(row.is_done() ? fmt::format("{}", row.steps) : "");
    line.push_back(row.error ? percent(*row.error) : row.is_done() ? "not compared" : row.status);
    line.push_back(row.is_done() ? fmt::format("{:.3g}", row.seconds()) : "");
    line.emplace_back(findings.pareto[r] ? "*" : "");
  }
  return aligned(lines, study.axes.size()) + "  * no other is both quicker and more accurate\n";
}

std::string orders_text(const Study& study, const Findings& findings) {
  if (findings.orders.empty()) return "";
  std::string text = fmt::format("\nObserved order of convergence in \"{}\"\n",
                                 study.axes[*study.refinement].name);
  for (const ChoiceOrder& order : findings.orders) {
    const std::string choice = choice_text(study.axes, order.choice, {*study.refinement});
    fmt::format_to(std::back_inserter(text), "  {}{:.2f}", choice.empty() ? "" : choice + ": ",
                   order.observed.order);
    if (order.observed.pairs.size() > 1)
      fmt::format_to(std::back_inserter(text), " (step by step {:.2f})",
                     fmt::join(order.observed.pairs, ", "));
    if (!order.observed.doubt.empty())
      fmt::format_to(std::back_inserter(text), ": not to be trusted, for {}", order.observed.doubt);
    text += '\n';
  }
  return text;
}

/// Returns "boundary particles"; "this scene" if the study varies the refinement alone.
std::string setting_text(const Study& study, const Choice& choice) {
  const std::string text = choice_text(study.axes, choice, {refinement_of(study)});
  return text.empty() ? "this scene" : text;
}

std::string limits_text(const Study& study, const Findings& findings) {
  if (findings.limits.empty()) return "";
  std::string text =
      "\nLimits to which the finest runs lead: those that answer the same should be the same\n";
  for (const LimitGap& gap : findings.limits)
    fmt::format_to(std::back_inserter(text), "  {} and {}: {} apart\n",
                   setting_text(study, gap.other), setting_text(study, gap.one),
                   percent(gap.apart));
  return text +
         "  An error is counted against the own limit; one smaller than this says nothing of the "
         "truth.\n";
}

/// Returns a warning if the error of a row is smaller than the uncertainty of its limit; empty
/// otherwise.
std::string limit_warning(const Study& study, const Findings& findings, const Row& row) {
  const LimitGap* widest = nullptr;
  for (const LimitGap& gap : findings.limits)
    if (study.refinement &&
        (same_but({*study.refinement}, gap.one, row.choice) ||
         same_but({*study.refinement}, gap.other, row.choice)) &&
        (widest == nullptr || gap.apart > widest->apart))
      widest = &gap;
  if (widest == nullptr || !row.error || widest->apart <= *row.error) return "";
  return fmt::format(
      " The limits of {} and {} are {} apart, though, so that such an error says nothing of the "
      "truth.",
      setting_text(study, widest->other), setting_text(study, widest->one), percent(widest->apart));
}

std::string equal_errors_text(const Study& study, const Findings& findings) {
  if (findings.equal_errors.empty()) return "";
  std::string text = "\nRun times at equal error, against the setting with the most accurate run\n";
  for (const EqualError& equal : findings.equal_errors)
    fmt::format_to(std::back_inserter(text),
                   "  {} takes {}{:.2g} times as long as {} for an error of {}: {:.3g} s against "
                   "{:.3g} s\n",
                   setting_text(study, equal.setting), equal.is_bound ? "at least " : "",
                   equal.times(), setting_text(study, equal.reference), percent(equal.error),
                   equal.seconds, equal.reference_seconds);
  return text;
}

std::string peers_text(const Study& study) {
  if (study.peers.empty()) return "";
  Lines lines{{"peer", "error", "seconds"}};
  for (const Peer& peer : study.peers)
    lines.push_back(
        {shown_whole(peer.label), percent(peer.error), fmt::format("{:.3g}", peer.seconds)});
  return '\n' + aligned(lines, 1);
}

/// Predicts by the observed orders which setting meets the target at the coarsest size, which is
/// the cheapest. A setting with several cases needs the size of its hardest case.
std::string promise(const Study& study, const std::vector<Row>& rows, const Findings& findings) {
  const std::size_t cases = count_cases(study, rows);
  std::vector<std::size_t> free =
      study.cases;  // axes that may differ between the cases of a setting
  free.push_back(*study.refinement);
  const ChoiceOrder* best = nullptr;
  double size = 0;
  for (const ChoiceOrder& order : findings.orders) {
    double needed = infinity;
    std::size_t answered = 0;
    for (const ChoiceOrder& other : findings.orders)
      if (same_but(free, other.choice, order.choice)) {
        ++answered;
        needed = std::min(needed, size_for(other.observed, *findings.target).value_or(0));
      }
    if (answered != cases || needed <= size) continue;
    best = &order;
    size = needed;
  }
  if (best == nullptr) return "";
  const std::string choice = choice_text(study.axes, best->choice, free);
  return fmt::format(" By its observed order, {} would meet it{} at a {} of about {:.2g} (SI).",
                     choice.empty() ? "the scene" : choice,
                     study.cases.empty() ? "" : " in every case",
                     study.axes[*study.refinement].name, size);
}

}  // namespace

std::string cheapest_sentence(const Study& study, const std::vector<Row>& rows,
                              const Findings& findings) {
  if (!findings.target) return "";
  const auto setting = [&](std::size_t r) {
    std::vector<std::size_t> settings(study.axes.size());
    std::iota(settings.begin(), settings.end(), std::size_t{0});
    std::erase_if(settings, [&](std::size_t a) {
      return std::find(study.cases.begin(), study.cases.end(), a) != study.cases.end();
    });
    const std::string cases = choice_text(study.axes, rows[r].choice, settings);
    double seconds = 0;
    for (const Row& row : rows)
      if (same_but(study.cases, row.choice, rows[r].choice)) seconds += row.seconds();
    return fmt::format("{}: error {}{}, {:.3g} s{}, {} particles",
                       choice_text(study.axes, rows[r].choice, study.cases),
                       percent(*rows[r].error), cases.empty() ? "" : " at most, with " + cases,
                       seconds, cases.empty() ? "" : " for all cases together", rows[r].particles);
  };
  const std::string target = percent(*findings.target);
  if (findings.cheapest)
    return fmt::format("The cheapest setting for an error of {} is {}.", target,
                       setting(*findings.cheapest)) +
           limit_warning(study, findings, rows[*findings.cheapest]);
  if (!findings.best)
    return fmt::format("No setting was compared, so none is known to have an error of {}.", target);
  return fmt::format("No setting has an error of {} or less; the most accurate is {}.", target,
                     setting(*findings.best)) +
         (study.refinement ? promise(study, rows, findings) : "");
}

Json study_json(const Study& study, const std::vector<Row>& rows, const Findings& findings) {
  Json json = {{"title", study.title},
               {"norm", study.is_sweep() ? Json(nullptr)
                                         : Json(norm_names[static_cast<std::size_t>(study.norm)])},
               {"rows", Json::array()},
               {"orders", Json::array()}};
  for (std::size_t r = 0; r < rows.size(); ++r)
    json["rows"].push_back(row_json(study, rows[r], findings.pareto[r]));
  for (const ChoiceOrder& order : findings.orders)
    json["orders"].push_back(order_json(study, order));
  json["limits"] = Json::array();
  for (const LimitGap& gap : findings.limits)
    json["limits"].push_back({{"of", choice_json(study, gap.one)},
                              {"against", choice_json(study, gap.other)},
                              {"apart", gap.apart}});
  json["equal_errors"] = Json::array();
  for (const EqualError& equal : findings.equal_errors)
    json["equal_errors"].push_back({{"of", choice_json(study, equal.setting)},
                                    {"against", choice_json(study, equal.reference)},
                                    {"error", equal.error},
                                    {"seconds", equal.seconds},
                                    {"against_seconds", equal.reference_seconds},
                                    {"times", equal.times()},
                                    {"bound", equal.is_bound}});
  json["target_error"] = findings.target ? Json(*findings.target) : Json(nullptr);
  json["cheapest"] = findings.cheapest ? row_json(study, rows[*findings.cheapest],
                                                  findings.pareto[*findings.cheapest])
                                       : Json(nullptr);
  json["sentence"] = cheapest_sentence(study, rows, findings);
  json["peers"] = Json::array();
  for (const Peer& peer : study.peers)
    json["peers"].push_back(
        {{"label", peer.label}, {"error", peer.error}, {"seconds", peer.seconds}});
  return json;
}

std::string study_csv(const Study& study, const std::vector<Row>& rows, const Findings& findings) {
  if (study.is_sweep()) return sweep_csv(study, rows);
  std::string text;
  for (const Axis& axis : study.axes) text += axis.name + ',';
  text += "particles,steps,error,seconds,setup_seconds,pareto,status";
  for (const Comparison& comparison : study.comparisons) text += ",error " + comparison.name;
  text += '\n';
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      text += study.axes[a].labels[row.choice[a]] + ',';
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}", row.particles, row.steps,
                   row.error ? fmt::format("{}", *row.error) : "", row.seconds(), row.setup_seconds,
                   findings.pareto[r] ? 1 : 0, row.status);
    for (std::size_t c = 0; c < study.comparisons.size(); ++c)
      text += c < row.errors.size() ? fmt::format(",{}", row.errors[c]) : ",";
    text += '\n';
  }
  return text;
}

std::string study_text(const Study& study, const std::vector<Row>& rows, const Findings& findings) {
  std::string text =
      (study.title.empty() ? "" : study.title + "\n\n") +
      (study.is_sweep() ? sweep_table(study, rows) : table_text(study, rows, findings)) +
      peers_text(study);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto same = [&](const Row& row) { return row.reason == rows[r].reason; };
    if (rows[r].reason.empty() || std::find_if(rows.begin(), rows.end(), same) !=
                                      rows.begin() + static_cast<std::ptrdiff_t>(r))
      continue;
    const auto more = std::count_if(rows.begin(), rows.end(), same) - 1;
    fmt::format_to(std::back_inserter(text), "\n{}{}{}: {}\n",
                   choice_text(study.axes, rows[r].choice),
                   more > 0 ? fmt::format(" and {} more", more) : "",
                   rows[r].is_done() ? "" : " failed", rows[r].reason);
  }
  text += orders_text(study, findings) + limits_text(study, findings) +
          equal_errors_text(study, findings);
  const std::string sentence = cheapest_sentence(study, rows, findings);
  return shown_whole(text + (sentence.empty() ? "" : '\n' + sentence + '\n'));
}

}  // namespace hyperlattice::study
