#include <run/history.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

std::vector<std::string> history_columns(const Model& model) {
  std::vector<std::string> columns{"time",
                                   "step",
                                   "kinetic",
                                   "kinetic_mean",
                                   "stored",
                                   "dissipated",
                                   "dissipated_failure",
                                   "dissipated_damping",
                                   "injected",
                                   "balance_error",
                                   "relative_error",
                                   "momentum_x",
                                   "momentum_y",
                                   "momentum_z",
                                   "broken_open",
                                   "broken_closed"};
  if (!model.cohesive.empty()) columns.insert(columns.end(), {"surface_energy", "crack_area"});
  for (const Load& load : model.loads) columns.push_back("work_" + load.stage->name);
  return columns;
}

void History::archive(Archive& archive) {
  archive(last_);
  archive(has_record_);
  archive(largest_relative_error_);
}

void History::begin() { table_ = &folder_.table("history.csv", history_columns(model_)); }

void History::take(const Record& record) {
  last_ = record;
  has_record_ = true;
  largest_relative_error_ =
      std::max(largest_relative_error_, std::abs(record.balance.relative_error()));
}

void History::write(const std::vector<double>& work) {
  const EnergyBalance& b = last_.balance;
  std::vector<double> values{last_.time,
                             static_cast<double>(last_.step),
                             b.kinetic,
                             b.kinetic_mean,
                             b.stored,
                             b.dissipated(),
                             b.dissipated_failure,
                             b.dissipated_damping,
                             b.injected,
                             b.error,
                             b.relative_error(),
                             b.momentum.x,
                             b.momentum.y,
                             b.momentum.z,
                             static_cast<double>(last_.broken_open),
                             static_cast<double>(last_.broken_closed)};
  if (has_cracks_) values.insert(values.end(), {last_.cracks.energy, last_.cracks.area});
  values.insert(values.end(), work.begin(), work.end());
  table_->row(values);
}

}  // namespace hyperlattice
