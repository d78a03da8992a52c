#include <report/stress_strain.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice::report {

namespace {

/// Returns the curve up to the first row whose times differ: a table of a run that was cut off may
/// have fewer rows. Nothing to draw if the probes have different times.
Series curve(const Probe& cell, const Probe& gauge) {
  Series series{fmt::format("{} over {}", cell.name, gauge.name), {}, {}};
  const auto &stress = *cell.table.find("stress"), &strain = *gauge.table.find("strain"),
             &time = cell.table.values.front(), &other = gauge.table.values.front();
  for (std::size_t n = 0; n < std::min(stress.size(), strain.size()) && time[n] == other[n]; ++n) {
    series.x.push_back(strain[n]);
    series.y.push_back(stress[n]);
  }
  return series;
}

}  // namespace

Plot stress_over_strain(const RunRecord& run) {
  Plot plot{"Stress over strain", {"strain", ""}, {"stress", "Pa"}, {}};
  for (const Probe& cell : run.probes) {
    if (cell.table.find("stress") == nullptr) continue;
    for (const Probe& gauge : run.probes)
      if (gauge.table.find("strain") != nullptr)
        if (Series series = curve(cell, gauge); series.x.size() > 1)
          plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace hyperlattice::report
