#include <study/equal_error.hpp>
#include <study/front.hpp>

#include <algorithm>

namespace hyperlattice::study {

namespace {

/// A setting with the costs of its runs.
struct SettingCosts {
  Choice choice;
  std::vector<Cost> costs;
  Cost best;  ///< of its most accurate run
};

std::vector<SettingCosts> costs_of_settings(const Study& study, const std::vector<Row>& rows) {
  std::vector<SettingCosts> settings;
  for (const auto& members : families(study, rows)) {
    SettingCosts setting{rows[members.front()].choice, {}, {}};
    for (const std::size_t r : members)
      if (rows[r].error && rows[r].seconds() > 0)
        setting.costs.push_back({*rows[r].error, rows[r].seconds()});
    const auto best = most_accurate(setting.costs);
    if (!best) continue;
    setting.best = setting.costs[*best];
    settings.push_back(std::move(setting));
  }
  return settings;
}

}  // namespace

std::vector<EqualError> compare_at_equal_error(const Study& study, const std::vector<Row>& rows) {
  std::vector<EqualError> found;
  if (!study.refinement) return found;
  const std::vector<SettingCosts> settings = costs_of_settings(study, rows);
  for (const SettingCosts& setting : settings) {
    const SettingCosts* reference = &setting;
    for (const SettingCosts& other : settings)
      if (same_case(study, setting.choice, other.choice) &&
          other.best.error < reference->best.error)
        reference = &other;
    if (reference == &setting) continue;
    const double error = setting.best.error;
    const auto seconds = seconds_for(reference->costs, error);
    const bool is_bound = std::all_of(reference->costs.begin(), reference->costs.end(),
                                      [&](const Cost& cost) { return cost.error < error; });
    found.push_back({setting.choice, reference->choice, error, setting.best.seconds,
                     seconds.value(), is_bound});
  }
  return found;
}

}  // namespace hyperlattice::study
