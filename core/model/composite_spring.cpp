#include <model/composite_spring.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hyperlattice {

CompositeSpring::CompositeSpring(std::span<const Law> laws, std::vector<SpringPart> parts,
                                 Joined joined)
    : laws_(laws), parts_(std::move(parts)), joined_(joined) {
  for (const SpringPart& part : parts_) {
    first_.push_back(memory_);
    memory_ += laws_[part.law].kernels.memory;
  }
  if (joined_ == Joined::in_series) ++memory_;  // e_1
}

/// Stiffnesses of opposite sign, which only some membranes have, are not in series: such springs
/// are side by side with equal weights.
bool CompositeSpring::in_series(std::size_t cross) const {
  return joined_ == Joined::in_series &&
         (parts_[0].stiffness[cross] > 0) == (parts_[1].stiffness[cross] > 0);
}

/// A spring in series with nothing has no force.
bool CompositeSpring::is_absent(std::size_t cross) const {
  return joined_ == Joined::in_series &&
         (parts_[0].stiffness[cross] == 0 || parts_[1].stiffness[cross] == 0);
}

OneSpring CompositeSpring::one(const Spring& spring, std::size_t n, double elongation) const {
  const SpringPart& part = parts_[n];
  return {spring.factor * part.stiffness[spring.cross], spring.rest_length, elongation,
          part.constants[spring.cross], nullptr};
}

SpringAnswer CompositeSpring::take_part(const Spring& spring, std::size_t n, double elongation,
                                        double time_step, double* kept) const {
  return take_spring(laws_[parts_[n].law], one(spring, n, elongation), time_step, kept + first_[n]);
}

void CompositeSpring::start(const SpringIdentity& identity, std::size_t cross, double* kept) const {
  for (std::size_t n = 0; n < parts_.size(); ++n)
    start_spring(laws_[parts_[n].law], parts_[n].constants[cross], identity, kept + first_[n]);
}

void CompositeSpring::add(CompositeAnswer& sum, std::size_t n, double weight,
                          const SpringAnswer& part) const {
  sum.stored += weight * part.energy;
  (laws_[parts_[n].law].kernels.softens ? sum.fractured : sum.dissipated) +=
      weight * part.dissipated;
}

CompositeAnswer CompositeSpring::take(const Spring& spring, double time_step, double* kept) const {
  CompositeAnswer sum;
  if (is_absent(spring.cross)) return sum;
  if (in_series(spring.cross)) {
    const double first = solve(spring, time_step, kept);
    for (std::size_t n = 0; n < 2; ++n) {
      const double elongation = n == 0 ? first : 2 * spring.elongation - first;
      const SpringAnswer part = take_part(spring, n, elongation, time_step, kept);
      sum.force += 0.5 * part.force;  // both have the same, but for round-off
      sum.integrity = std::min(sum.integrity, part.integrity);
      add(sum, n, 0.5, part);
    }
    kept[memory_ - 1] = first;
    return sum;
  }
  sum.integrity = 0;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const double weight = parts_[n].weight;
    const SpringAnswer part = take_part(spring, n, spring.elongation, time_step, kept);
    sum.force += weight * part.force;
    sum.integrity += weight * part.integrity;
    add(sum, n, weight, part);
  }
  return sum;
}

CompositeAnswer CompositeSpring::present(const Spring& spring, const double* kept) const {
  CompositeAnswer sum;
  if (is_absent(spring.cross)) return sum;
  const bool series = in_series(spring.cross);
  if (!series) sum.integrity = 0;
  for_parts(spring, kept, [&](const Law& law, const OneSpring& part, double weight) {
    const SpringAnswer answer = ask_spring(law, part);
    sum.force += weight * answer.force;
    sum.stored += weight * answer.energy;
    sum.integrity = series ? std::min(sum.integrity, answer.integrity)
                           : sum.integrity + weight * answer.integrity;
  });
  return sum;
}

double CompositeSpring::elongation_of(std::size_t n, double elongation, const double* kept) const {
  if (joined_ != Joined::in_series) return elongation;
  return n == 0 ? kept[memory_ - 1] : 2 * elongation - kept[memory_ - 1];
}

double CompositeSpring::tangent(const Spring& spring, double time_step, const double* kept) const {
  const double h = 1e-7 * spring.rest_length;
  const auto force = [&](double elongation) {
    std::array<double, max_spring_memory> trial{};
    std::copy_n(kept, memory_, trial.begin());
    Spring moved = spring;
    moved.elongation = elongation;
    return take(moved, time_step, trial.data()).force;
  };
  return (force(spring.elongation + h) - force(spring.elongation - h)) / (2 * h);
}

/// Returns e_1: the root of g = f_1(e_1) - f_2(2 u - e_1) by the secant method within a bracket. g
/// grows with e_1, except where a part softens faster than the other one unloads; then the root
/// nearest to the last one along the slope is taken, and what the jump releases is dissipated.
double CompositeSpring::solve(const Spring& spring, double time_step, const double* kept) const {
  const double stiffness =
      spring.factor * (parts_[0].stiffness[spring.cross] + parts_[1].stiffness[spring.cross]);
  double scale = 0;
  const auto difference = [&](double first) {
    std::array<double, max_spring_memory> trial{};
    std::copy_n(kept, memory_, trial.begin());
    const double f_1 = take_part(spring, 0, first, time_step, trial.data()).force,
                 f_2 = take_part(spring, 1, 2 * spring.elongation - first, time_step, trial.data())
                           .force;
    scale = std::max(std::abs(f_1), std::abs(f_2));
    return f_1 - f_2;
  };
  constexpr double relative = 1e-14, smallest = 1e-18;
  constexpr int most = 200;
  double e = kept[memory_ - 1], g = difference(e), slope = stiffness;
  double low = -infinity, high = infinity;  // g has the sign of the stiffness at `high`
  for (int n = 0; n < most; ++n) {
    if (std::abs(g) <= relative * scale ||
        std::abs(g) <= smallest * std::abs(stiffness) * spring.rest_length)
      return e;
    ((g > 0) == (stiffness > 0) ? high : low) = e;
    double next = e - g / slope;
    if (!(next > low && next < high)) {
      const double way = std::max(std::abs(e) * 0.5, 1e-6 * spring.rest_length);
      next = std::isfinite(low) && std::isfinite(high) ? 0.5 * (low + high)
             : std::isfinite(low)                      ? e + way
                                                       : e - way;
    }
    if (next == e || next == low || next == high) return next;
    const double g_next = difference(next);
    const double secant = (g_next - g) / (next - e);
    slope = (secant > 0) == (stiffness > 0) && secant != 0 ? secant : stiffness;
    e = next;
    g = g_next;
  }
  return e;
}

}  // namespace hyperlattice
