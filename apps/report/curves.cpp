#include <report/curves.hpp>
#include <report/probe_curves.hpp>
#include <report/stress_strain.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice::report {

namespace {

struct Quantity {
  const char* column;
  const char* name;
};
constexpr Quantity energies[] = {{"kinetic", "kinetic"},
                                 {"stored", "stored"},
                                 {"dissipated", "dissipated"},
                                 {"injected", "injected"}};
constexpr const char* crack_area = "crack_area";
constexpr Quantity broken[] = {{"broken_open", "open"}, {"broken_closed", "closed"}};

/// Returns whether time passed in the run; states of rest may all have the same time.
bool has_time(const RunRecord& run) {
  const auto* time = run.history.find("time");
  return time != nullptr && !time->empty() && time->back() > time->front();
}

Axis axis_over(bool over_time) { return over_time ? Axis{"time", "s"} : Axis{"step", "", true}; }

Series series_of(const RunRecord& run, bool over_time, const char* column, std::string label) {
  const auto *x = run.history.find(over_time ? "time" : "step"), *y = run.history.find(column);
  return x != nullptr && y != nullptr ? Series{std::move(label), *x, *y}
                                      : Series{std::move(label), {}, {}};
}

bool any_above_zero(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(), [](const Series& series) {
    return std::any_of(series.y.begin(), series.y.end(), [](double y) { return y != 0; });
  });
}

void keep(std::vector<Plot>& plots, Plot plot) {
  if (has_points(plot)) plots.push_back(std::move(plot));
}

}  // namespace

std::vector<Plot> plots_of(const RunRecord& run) {
  const bool over_time = has_time(run);
  const Axis x = axis_over(over_time);
  std::vector<Plot> plots;
  Plot energy{"Energies", x, {"energy", "J"}, {}};
  for (const auto& [column, name] : energies)
    energy.series.push_back(series_of(run, over_time, column, name));
  energy.series.back().is_dashed = true;  // the curves of injected and stored energy often coincide
  keep(plots, std::move(energy));
  keep(plots, {"Error of the energy balance",
               x,
               {"share of the largest energy", ""},
               {series_of(run, over_time, "relative_error", "error")}});
  Plot breakage{"Broken springs", x, {"springs", "", true}, {}};
  for (const auto& [column, name] : broken)
    breakage.series.push_back(series_of(run, over_time, column, name));
  if (any_above_zero(breakage)) keep(plots, std::move(breakage));
  Plot cracks{"Area of cracks", x, {"area", "m2"}, {series_of(run, over_time, crack_area, "area")}};
  if (any_above_zero(cracks)) keep(plots, std::move(cracks));
  keep(plots, stress_over_strain(run));
  for (const Probe& probe : run.probes)
    for (Plot& plot : plots_of(probe)) keep(plots, std::move(plot));
  return plots;
}

std::vector<Plot> plots_together(std::span<const RunRecord> runs) {
  const bool over_time = std::any_of(runs.begin(), runs.end(), has_time);
  const auto together = [&](std::string title, Axis y, const char* column) {
    Plot plot{std::move(title), axis_over(over_time), std::move(y), {}};
    for (const RunRecord& run : runs)
      plot.series.push_back(series_of(run, over_time, column, run.label));
    return plot;
  };
  std::vector<Plot> plots;
  for (const auto& [column, name] : energies)
    keep(plots, together(fmt::format("Energy, {}", name), {"energy", "J"}, column));
  keep(plots, together("Error of the energy balance", {"share of the largest energy", ""},
                       "relative_error"));
  for (const auto& [column, name] : broken)
    if (Plot plot =
            together(fmt::format("Broken springs, {}", name), {"springs", "", true}, column);
        any_above_zero(plot))
      keep(plots, std::move(plot));
  if (Plot plot = together("Area of cracks", {"area", "m2"}, crack_area); any_above_zero(plot))
    keep(plots, std::move(plot));
  Plot stress{"Stress over strain", {"strain", ""}, {"stress", "Pa"}, {}};
  for (const RunRecord& run : runs)
    for (Series& series : stress_over_strain(run).series) {
      series.label = fmt::format("{}: {}", run.label, series.label);
      stress.series.push_back(std::move(series));
    }
  keep(plots, std::move(stress));
  for (Plot& plot : probes_together(runs)) keep(plots, std::move(plot));
  return plots;
}

}  // namespace hyperlattice::report
