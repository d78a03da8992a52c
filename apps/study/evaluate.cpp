#include <base/folder_file.hpp>
#include <study/evaluate.hpp>
#include <study/expected.hpp>
#include <study/observe.hpp>
#include <study/study_runs.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hyperlattice::study {

std::size_t count_cases(const Study& study, const std::vector<Row>& rows) {
  std::set<Choice> cases;
  for (const Row& row : rows) {
    Choice asked;
    for (const std::size_t axis : study.cases) asked.push_back(row.choice[axis]);
    cases.insert(asked);
  }
  return cases.size();
}

namespace {

class Evaluation {
 public:
  Evaluation(const Study& study, const std::filesystem::path& directory, std::vector<Row>& rows)
      : study_(study), directory_(directory), rows_(rows), curves_(rows.size()) {}

  std::vector<LimitGap> run() {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].is_done()) guarded(rows_[r], [&] { observe(r); });
    if (study_.is_sweep()) return {};
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].is_done()) guarded(rows_[r], [&] { compare(r); });
    return compare_limits();
  }

 private:
  struct ObservedCurve {
    Curve curve;
    std::optional<double> place;
  };

  /// Runs `code`. NoLimit leaves the row done, with a reason; other exceptions make it a failed
  /// row.
  template <class Code>
  static void guarded(Row& row, Code&& code) {
    try {
      code();
    } catch (const NoLimit& error) {
      row.errors.clear();
      row.reason = std::string("it was run, but not compared: ") + error.what();
    } catch (const std::runtime_error& error) {
      row.errors.clear();
      row.fail(std::string("it was run but cannot be compared: ") + error.what(), exit_run);
    }
  }

  const Truth& truth_of(const Row& row) const {
    return *std::find_if(study_.truths.begin(), study_.truths.end(),
                         [&](const Truth& truth) { return truth.when.holds(row.choice); });
  }

  void observe(std::size_t r) {
    const bool number = study_.is_sweep() || truth_of(rows_[r]).kind == Truth::Kind::numbers;
    for (const Comparison& comparison : study_.comparisons) {
      const std::filesystem::path name = comparison.file();
      const auto file =
          read_folder_file(run_directory(directory_, rows_[r].run, 1), name, largest_table);
      if (!file || !file->refusal.empty())
        throw std::runtime_error(
            fmt::format("{} is {}", name.string(),
                        file ? file->refusal + ", and only regular files are read" : "not there"));
      const CsvTable table = parse_csv(file->text);
      const Reduction reduction = number && comparison.reduction == Reduction::none
                                      ? Reduction::last
                                      : comparison.reduction;
      curves_[r].push_back(
          {reduced(observed_curve(comparison, table), reduction), place_of(comparison, table)});
      if (study_.is_sweep()) rows_[r].values.push_back(curves_[r].back().curve.values.back());
    }
  }

  void compare(std::size_t r) {
    Row& row = rows_[r];
    std::vector<Distance> apart;
    for (std::size_t c = 0; c < study_.comparisons.size(); ++c) {
      const Comparison& comparison = study_.comparisons[c];
      try {
        apart.push_back(distance(curves_[r][c].curve, truth_curve(r, c), study_.norm));
        if (study_.norm != Norm::together_l2)
          row.errors.push_back(apart.back().relative(study_.norm));
      } catch (const NoLimit& error) {
        throw NoLimit(comparison.name + ": " + error.what());
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(comparison.name + ": " + error.what());
      }
    }
    double whole = 0;
    if (study_.norm == Norm::together_l2)
      whole = compare_together(row, apart);
    else
      whole = *std::max_element(row.errors.begin(), row.errors.end());
    const bool is_finite = std::all_of(row.errors.begin(), row.errors.end(),
                                       [](double error) { return std::isfinite(error); });
    if (!is_finite || !std::isfinite(whole))
      throw std::runtime_error("the error is no finite number");
    row.error = whole;
  }

  /// Computes the errors of Norm::together_l2. The error of each quantity is relative to the size
  /// of all together, so that the squares of the errors add up.
  static double compare_together(Row& row, const std::vector<Distance>& apart) {
    const Distance whole = sum(apart);
    for (const Distance& one : apart)
      row.errors.push_back(Distance{one.difference, whole.size}.relative(Norm::together_l2));
    return whole.relative(Norm::together_l2);
  }

  static Distance sum(const std::vector<Distance>& parts) {
    Distance whole;
    for (const Distance& one : parts)
      whole = {whole.difference + one.difference, whole.size + one.size};
    return whole;
  }

  /// Returns the distance of the limits of two rows' families in the study's norm; nothing if they
  /// cannot be compared.
  std::optional<double> apart(std::size_t r, std::size_t other) const {
    std::vector<Distance> parts;
    double largest = 0;
    try {
      for (std::size_t c = 0; c < study_.comparisons.size(); ++c) {
        parts.push_back(distance(limit(r, c), limit(other, c), study_.norm));
        if (study_.norm != Norm::together_l2)
          largest = std::max(largest, parts.back().relative(study_.norm));
      }
      return study_.norm == Norm::together_l2 ? sum(parts).relative(study_.norm) : largest;
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }

  /// Compares the limit of each setting with that of the first setting of the same case. Both
  /// settings solve the same problem, so that the limits should agree.
  std::vector<LimitGap> compare_limits() const {
    std::vector<LimitGap> gaps;
    if (!study_.refinement) return gaps;
    std::vector<std::size_t> firsts;  // the first row of each family
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto same_family = [&](std::size_t first) {
        return same_but({*study_.refinement}, rows_[first].choice, rows_[r].choice);
      };
      if (!rows_[r].error || truth_of(rows_[r]).kind != Truth::Kind::finest ||
          std::any_of(firsts.begin(), firsts.end(), same_family))
        continue;
      const auto rival = std::find_if(firsts.begin(), firsts.end(), [&](std::size_t first) {
        return same_case(study_, rows_[first].choice, rows_[r].choice);
      });
      if (rival != firsts.end())
        if (const auto gap = apart(r, *rival))
          gaps.push_back({rows_[r].choice, rows_[*rival].choice, *gap});
      firsts.push_back(r);
    }
    return gaps;
  }

  Curve truth_curve(std::size_t r, std::size_t c) const {
    const Truth& truth = truth_of(rows_[r]);
    return truth.kind == Truth::Kind::finest
               ? limit(r, c)
               : true_curve(study_.comparisons[c], truth, curves_[r][c].place, rows_[r].numbers);
  }

  /// Returns the limit of the runs that differ from row `r` in the refinement alone.
  Curve limit(std::size_t r, std::size_t c) const {
    std::vector<SizedCurve> family;
    for (std::size_t other = 0; other < rows_.size(); ++other)
      if (curves_[other].size() > c &&
          same_but({*study_.refinement}, rows_[other].choice, rows_[r].choice))
        family.push_back({*rows_[other].numbers[*study_.refinement], curves_[other][c].curve});
    std::sort(family.begin(), family.end(),
              [](const SizedCurve& a, const SizedCurve& b) { return a.size > b.size; });
    return extrapolated(family, truth_of(rows_[r]).order);
  }

  const Study& study_;
  const std::filesystem::path& directory_;
  std::vector<Row>& rows_;
  std::vector<std::vector<ObservedCurve>> curves_;  // for each row and comparison
};

std::vector<ChoiceOrder> find_orders(const Study& study, const std::vector<Row>& rows) {
  std::vector<ChoiceOrder> orders;
  if (!study.refinement) return orders;
  for (const auto& members : families(study, rows)) {
    std::vector<SizedError> errors;
    for (const std::size_t r : members)
      if (rows[r].error) errors.push_back({*rows[r].numbers[*study.refinement], *rows[r].error});
    if (auto observed = observed_order(std::move(errors)))
      orders.push_back({rows[members.front()].choice, std::move(*observed)});
  }
  return orders;
}

/// The cost of a setting over all cases: the sum of the run times and the largest error, which row
/// `row` has.
struct Setting {
  std::size_t row = 0;
  Cost cost;
};

/// Returns the settings whose error is known in every case of the study.
std::vector<Setting> settings_of(const Study& study, const std::vector<Row>& rows) {
  std::vector<Setting> settings;
  std::vector<bool> taken(rows.size());
  const std::size_t cases = count_cases(study, rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (taken[r]) continue;
    Setting setting{r, {0, 0}};
    bool known = true;
    std::size_t answered = 0;
    for (std::size_t other = r; other < rows.size(); ++other) {
      if (!same_but(study.cases, rows[other].choice, rows[r].choice)) continue;
      taken[other] = true;
      ++answered;
      known = known && rows[other].error.has_value();
      if (!known) continue;
      if (*rows[other].error >= setting.cost.error)
        setting = {other, {*rows[other].error, setting.cost.seconds}};
      setting.cost.seconds += rows[other].seconds();
    }
    if (known && answered == cases) settings.push_back(setting);
  }
  return settings;
}

}  // namespace

std::vector<LimitGap> find_errors(const Study& study, const std::filesystem::path& directory,
                                  std::vector<Row>& rows) {
  return Evaluation(study, directory, rows).run();
}

Findings find(const Study& study, const std::vector<Row>& rows, std::vector<LimitGap> limits) {
  Findings findings;
  findings.limits = std::move(limits);
  std::vector<Cost> costs;
  std::vector<std::size_t> place;  // row of each cost
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
    if (const auto found = cheapest(of_settings, *findings.target))
      findings.cheapest = settings[*found].row;
  findings.orders = find_orders(study, rows);
  findings.equal_errors = compare_at_equal_error(study, rows);
  return findings;
}

}  // namespace hyperlattice::study
