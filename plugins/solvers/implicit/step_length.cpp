#include "step_length.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace hyperlattice::implicit {

namespace {

double root_mean_square(const equilibrium::Field& field) {
  const double unit = equilibrium::power_of_two(equilibrium::largest(field));
  if (!(unit > 0)) return 0;
  double square = 0;
  for (const double value : field) square += value / unit * (value / unit);
  return unit * std::sqrt(square / static_cast<double>(field.size()));
}

}  // namespace

double StepLength::next(double left) const {
  const double h = std::min(length_, longest_);
  const double parts = std::ceil(left / h * (1 - 1e-9));
  return parts <= 2 ? left / std::max(1.0, parts) : h;
}

/// Returns the local error, m, of a step with this mean velocity; 0 if it is not known yet.
double StepLength::error(double h, const equilibrium::Field& velocity) const {
  if (one_before_ == 0) return 0;
  const double slope = (h + last_) / (last_ + one_before_);
  equilibrium::Field bend(velocity.size());
  for (std::size_t n = 0; n < bend.size(); ++n)
    bend[n] = velocity[n] - velocity_[n] - slope * (velocity_[n] - velocity_before_[n]);
  return h / 12 * root_mean_square(bend);
}

bool StepLength::accept(double h, const equilibrium::Field& change, const equilibrium::Field& end) {
  constexpr double safety = 0.9, most = 2, least = 0.3, worth = 1.2, too_much = 2;
  equilibrium::Field velocity(change.size());
  for (std::size_t n = 0; n < change.size(); ++n) velocity[n] = change[n] / h;
  largest_ = std::max({largest_, root_mean_square(end), root_mean_square(change)});
  failures_ = 0;
  if (tolerance_ > 0) {
    const double relative = largest_ > 0 ? error(h, velocity) / (tolerance_ * largest_) : 0;
    const double factor =
        one_before_ == 0 ? 1
                         : std::clamp(safety / std::cbrt(std::max(relative, 1e-12)), least, most);
    if (factor > worth || factor < 1) length_ = std::min(h * factor, longest_);
    if (relative > too_much) return false;
  } else {
    length_ = std::min(longest_, 2 * length_);
  }
  one_before_ = std::exchange(last_, h);
  velocity_before_ = std::exchange(velocity_, std::move(velocity));
  return true;
}

bool StepLength::shorten(double h) {
  constexpr int most_failures = 10;
  length_ = h / 2;
  return ++failures_ < most_failures;
}

void StepLength::remember(std::vector<double>& memory) const {
  memory.insert(memory.end(), {length_, largest_, last_, one_before_});
  for (const equilibrium::Field* field : {&velocity_, &velocity_before_})
    memory.insert(memory.end(), field->begin(), field->end());
}

void StepLength::recall(std::span<const double> memory) {
  constexpr std::size_t numbers = 4;
  if (memory.size() < numbers) throw std::runtime_error("the checkpoint is of another solver");
  length_ = memory[0];
  largest_ = memory[1];
  last_ = memory[2];
  one_before_ = memory[3];
  const std::span<const double> fields = memory.subspan(numbers);
  // After the first step there is no velocity before it.
  const std::size_t size = one_before_ > 0 ? fields.size() / 2 : fields.size();
  velocity_.assign(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(size));
  velocity_before_.assign(fields.begin() + static_cast<std::ptrdiff_t>(size), fields.end());
}

}  // namespace hyperlattice::implicit
