#include <analyze/elasticity.hpp>
#include <analyze/membranes.hpp>
#include <model/stability.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

using calibration::Membrane;

constexpr Membrane with_lambda[] = {Membrane::I_m, Membrane::I, Membrane::II, Membrane::III, Membrane::IV};

std::string_view name(Membrane membrane) { return calibration::membrane_names[static_cast<std::size_t>(membrane)]; }

/// Of all membranes but one, those for which something holds, as a list of names.
template <class Holds>
std::string others(Membrane but, const Holds& holds) {
  std::string names;
  for (const Membrane other : with_lambda)
    if (other != but && holds(other)) names += (names.empty() ? "" : ", ") + std::string(name(other));
  return names;
}

/// C11 and C12 as functions of lambda: a + b lambda.
struct Line {
  double C11, C12;
};
struct LinearElasticity {
  Line start, slope;

  LinearElasticity(const LatticeGeometry& geometry, Membrane membrane) {
    const auto at = [&](double lambda) { return elasticity(with_ratios(geometry, calibration::ratios(membrane, lambda))); };
    const LatticeElasticity one = at(1), two = at(2);
    slope = {two.C11 - one.C11, two.C12 - one.C12};
    start = {one.C11 - slope.C11, one.C12 - slope.C12};
  }
  double poisson(double lambda) const {
    const double C12 = start.C12 + lambda * slope.C12;
    return C12 / (start.C11 + lambda * slope.C11 + C12);
  }
  double limit() const { return slope.C12 / (slope.C11 + slope.C12); }  ///< of the Poisson ratio, as lambda grows
  double lambda(double poisson) const {
    const double above = poisson * (start.C11 + start.C12) - start.C12, below = slope.C12 - poisson * (slope.C11 + slope.C12);
    constexpr double rounding = 1e-14;
    return std::abs(above) < rounding ? 0 : above / (std::abs(below) < rounding ? 0 : below);
  }
};

/// Where stability begins, going up; nothing if small positive lambda are unstable already.
std::optional<double> least_stable_lambda(const LatticeGeometry& geometry, Membrane membrane) {
  constexpr double small = 1e-6;
  const auto grows = [&](double lambda) { return !is_stable(geometry, calibration::ratios(membrane, lambda)); };
  double stable = small, unstable = -8;
  if (grows(stable)) return std::nullopt;
  while (stable - unstable > small) {
    const double middle = (stable + unstable) / 2;
    (grows(middle) ? unstable : stable) = middle;
  }
  return std::abs(stable) < 2 * small ? 0 : stable;
}

}  // namespace

bool has_lambda(Membrane membrane) { return std::find(std::begin(with_lambda), std::end(with_lambda), membrane) != std::end(with_lambda); }

bool is_stable(const LatticeGeometry& geometry, const calibration::Ratios& ratios) {
  const SpringLattice lattice = with_ratios(geometry, ratios);
  return !find_instability(lattice.endless(), Sector::mirrored);
}

bool is_stable(const LatticeGeometry& geometry, Membrane membrane, double lambda) {
  const std::optional<double> least = least_stable_lambda(geometry, membrane);
  constexpr double edge = 1e-5;
  return least && (*least == 0 ? lambda >= 0 : lambda > *least + edge) && is_stable(geometry, calibration::ratios(membrane, lambda));
}

SpringLattice with_ratios(const LatticeGeometry& geometry, const calibration::Ratios& ratios) {
  MaterialConstants constants;
  constants.density = constants.base_stiffness = 1;
  constants.cross_ratio[0] = ratios.beta;
  constants.cross_ratio[1] = geometry.spring_classes > 1 ? ratios.gamma : 0;
  constants.alpha_ratio = ratios.alpha;
  constants.clamped = ratios.clamped;
  return {geometry, constants};
}

std::optional<double> lambda_for(const LatticeGeometry& geometry, Membrane membrane, double poisson) {
  if (!has_lambda(membrane)) return std::nullopt;
  return LinearElasticity(geometry, membrane).lambda(poisson);
}

std::optional<calibration::Reach> reach(const LatticeGeometry& geometry, Membrane membrane) {
  if (!has_lambda(membrane)) return std::nullopt;
  const std::optional<double> least = least_stable_lambda(geometry, membrane);
  if (!least) return calibration::Reach{};
  const LinearElasticity linear(geometry, membrane);
  const double start = linear.poisson(*least), limit = linear.limit();
  return calibration::Reach{std::min(start, limit), std::max(start, limit), *least < 0 || limit > start};
}

std::string stable_sentence(const LatticeGeometry& geometry, Membrane membrane, double lambda) {
  const std::optional<double> least = least_stable_lambda(geometry, membrane);
  const std::string stable = others(membrane, [&](Membrane other) { return is_stable(geometry, other, lambda); });
  return (!least ? fmt::format("another membrane: {} is unstable for small lambda", name(membrane))
                 : fmt::format("{} {:.4g}: with less, membrane {} is unstable", *least == 0 ? "at least" : "above", *least, name(membrane))) +
         (stable.empty() ? "; no membrane of this lattice is stable with it" : fmt::format("; {} is stable with {}", lambda, stable));
}

std::string reach_sentence(const LatticeGeometry& geometry, Membrane membrane, double poisson) {
  const calibration::Reach own = reach(geometry, membrane).value_or(calibration::Reach{});
  const std::string reached_by = others(membrane, [&](Membrane other) {
    const std::optional<double> lambda = lambda_for(geometry, other, poisson);
    return std::isfinite(*lambda) && is_stable(geometry, other, *lambda);
  });
  return fmt::format(
      "within ({:.4g}, {:.4g}{}, the reach of membrane {}; {}", own.low, own.high, own.open ? ")" : "]", name(membrane),
      reached_by.empty() ? "no membrane of this lattice reaches it" : fmt::format("{} is within the reach of {}", poisson, reached_by));
}

}  // namespace hyperlattice
