#include <base/input_file.hpp>
#include <study/conduct.hpp>
#include <study/evaluate.hpp>
#include <study/expected.hpp>
#include <study/observe.hpp>

#include <algorithm>

namespace hyperlattice::study {

namespace {

/// Whether two choices differ in some axes alone.
bool same_but(const std::vector<std::size_t>& axes, Choice a, const Choice& b) {
  for (const std::size_t axis : axes) a[axis] = b[axis];
  return a == b;
}

class Evaluation {
 public:
  Evaluation(const Study& study, const std::filesystem::path& directory, std::vector<Row>& rows)
      : study_(study), directory_(directory), rows_(rows), curves_(rows.size()) {}

  void run() {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].is_done()) guarded(rows_[r], [&] { observe(r); });
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].is_done()) guarded(rows_[r], [&] { compare(r); });
  }

 private:
  struct Observed {
    Curve curve;
    std::optional<double> place;
  };

  /// A run that cannot be compared is a failed one, and the others go on.
  template <class Code>
  static void guarded(Row& row, Code&& code) {
    try {
      code();
    } catch (const std::runtime_error& error) {
      row.errors.clear();
      row.fail(std::string("it was run but cannot be compared: ") + error.what(), exit_run);
    }
  }

  const Truth& truth_of(const Row& row) const {
    return *std::find_if(study_.truths.begin(), study_.truths.end(), [&](const Truth& truth) { return truth.when.holds(row.choice); });
  }

  void observe(std::size_t r) {
    const bool number = truth_of(rows_[r]).kind == Truth::Kind::numbers;
    for (const Comparison& comparison : study_.comparisons) {
      const auto file = run_directory(directory_, rows_[r].run, 1) / "probes" / (comparison.probe + ".csv");
      const CsvTable table = parse_csv(read_input_file(file, file.string(), "the probe's table"));
      const Reduction reduction = number && comparison.reduction == Reduction::none ? Reduction::last : comparison.reduction;
      curves_[r].push_back({reduced(observed_curve(comparison, table), reduction), place_of(comparison, table)});
    }
  }

  void compare(std::size_t r) {
    Row& row = rows_[r];
    std::vector<Distance> apart;
    for (std::size_t c = 0; c < study_.comparisons.size(); ++c) {
      const Comparison& comparison = study_.comparisons[c];
      try {
        apart.push_back(distance(curves_[r][c].curve, truth_curve(r, c), study_.norm));
        if (study_.norm != Norm::together_l2) row.errors.push_back(apart.back().relative(study_.norm));
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(comparison.name + ": " + error.what());
      }
    }
    if (study_.norm == Norm::together_l2) return compare_together(row, apart);
    row.error = *std::max_element(row.errors.begin(), row.errors.end());
  }

  /// All quantities are one: each of their errors is in relation to the whole, so that their squares add up.
  static void compare_together(Row& row, const std::vector<Distance>& apart) {
    Distance whole;
    for (const Distance& one : apart) whole = {whole.difference + one.difference, whole.size + one.size};
    row.error = whole.relative(Norm::together_l2);
    for (const Distance& one : apart) row.errors.push_back(Distance{one.difference, whole.size}.relative(Norm::together_l2));
  }

  Curve truth_curve(std::size_t r, std::size_t c) const {
    const Truth& truth = truth_of(rows_[r]);
    if (truth.kind != Truth::Kind::finest) return true_curve(study_.comparisons[c], truth, curves_[r][c].place, rows_[r].numbers);
    std::vector<SizedCurve> family;
    for (std::size_t other = 0; other < rows_.size(); ++other)
      if (curves_[other].size() > c && same_but({*study_.refinement}, rows_[other].choice, rows_[r].choice))
        family.push_back({*rows_[other].numbers[*study_.refinement], curves_[other][c].curve});
    std::sort(family.begin(), family.end(), [](const SizedCurve& a, const SizedCurve& b) { return a.size > b.size; });
    return extrapolated(family, truth.order);
  }

  const Study& study_;
  const std::filesystem::path& directory_;
  std::vector<Row>& rows_;
  std::vector<std::vector<Observed>> curves_;  // of each row and comparison
};

std::vector<ChoiceOrder> find_orders(std::size_t refinement, const std::vector<Row>& rows) {
  std::vector<ChoiceOrder> orders;
  std::vector<bool> taken(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (taken[r]) continue;
    std::vector<SizedError> errors;
    for (std::size_t other = r; other < rows.size(); ++other) {
      if (!same_but({refinement}, rows[other].choice, rows[r].choice)) continue;
      taken[other] = true;
      if (rows[other].error) errors.push_back({*rows[other].numbers[refinement], *rows[other].error});
    }
    if (auto observed = observed_order(std::move(errors))) orders.push_back({rows[r].choice, std::move(*observed)});
  }
  return orders;
}

/// A setting that must do for several cases costs what they take together, and its error is the largest; `row` has it.
struct Setting {
  std::size_t row = 0;
  Cost cost;
};

/// Those whose error is known in every case.
std::vector<Setting> settings_of(const Study& study, const std::vector<Row>& rows) {
  std::vector<Setting> settings;
  std::vector<bool> taken(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (taken[r]) continue;
    Setting setting{r, {0, 0}};
    bool known = true;
    for (std::size_t other = r; other < rows.size(); ++other) {
      if (!same_but(study.cases, rows[other].choice, rows[r].choice)) continue;
      taken[other] = true;
      known = known && rows[other].error.has_value();
      if (!known) continue;
      if (*rows[other].error >= setting.cost.error) setting = {other, {*rows[other].error, setting.cost.seconds}};
      setting.cost.seconds += rows[other].seconds();
    }
    if (known) settings.push_back(setting);
  }
  return settings;
}

}  // namespace

void find_errors(const Study& study, const std::filesystem::path& directory, std::vector<Row>& rows) { Evaluation(study, directory, rows).run(); }

Findings find(const Study& study, const std::vector<Row>& rows) {
  Findings findings;
  std::vector<Cost> costs;
  std::vector<std::size_t> place;  // of each cost, its row
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows[r].error) {
      costs.push_back({*rows[r].error, rows[r].seconds()});
      place.push_back(r);
    }
  findings.pareto.assign(rows.size(), false);
  const std::vector<bool> front = pareto_front(costs);
  for (std::size_t n = 0; n < costs.size(); ++n) findings.pareto[place[n]] = front[n];
  const std::vector<Setting> settings = settings_of(study, rows);
  std::vector<Cost> of_settings;
  of_settings.reserve(settings.size());
  for (const Setting& setting : settings) of_settings.push_back(setting.cost);
  if (const auto best = most_accurate(of_settings)) findings.best = settings[*best].row;
  findings.target = study.target_error;
  if (findings.target)
    if (const auto found = cheapest(of_settings, *findings.target)) findings.cheapest = settings[*found].row;
  if (study.refinement) findings.orders = find_orders(*study.refinement, rows);
  return findings;
}

}  // namespace hyperlattice::study
