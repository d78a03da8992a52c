// The paper's membranes on any lattice: k_beta belongs to spring class 0, k_gamma to class 1. Finds
// the lambda of a Poisson ratio, and the Poisson ratios of stable lattices, from the elastic
// constants of the lattice. For the cubic lattice calibration.hpp has closed forms.
#pragma once

#include <hyperlattice/calibration.hpp>
#include <hyperlattice/material.hpp>

#include <algorithm>
#include <locale>
#include <optional>
#include <sstream>
#include <string>

namespace hyperlattice::membranes {

using calibration::Membrane;
using calibration::Ratios;
using calibration::Reach;

inline constexpr Membrane with_lambda[] = {Membrane::I_m, Membrane::I, Membrane::II, Membrane::III,
                                           Membrane::IV};

/// Returns whether the membrane has a lambda: all have one but none and free.
inline bool has_lambda(Membrane membrane) {
  return std::find(std::begin(with_lambda), std::end(with_lambda), membrane) !=
         std::end(with_lambda);
}

inline std::string_view name(Membrane membrane) {
  return calibration::membrane_names[static_cast<std::size_t>(membrane)];
}

/// Returns springs of stiffness k = 1 N/m with these ratios in the fourth dimension.
inline MaterialConstants constants(const LatticeFacts& lattice, const Ratios& ratios) {
  MaterialConstants constants;
  constants.density = constants.base_stiffness = 1;
  constants.cross_ratio[0] = ratios.beta;
  constants.cross_ratio[1] = lattice.spring_classes > 1 ? ratios.gamma : 0;
  constants.alpha_ratio = ratios.clamped ? 0 : ratios.alpha;
  constants.clamped = ratios.clamped;
  return constants;
}

/// Returns the k_gamma / k_beta that leaves C11 - C12 - 2 C44 as it is without a membrane: an
/// isotropic lattice stays isotropic. 3/4 for the cubic lattice; 0 for a lattice with one class of
/// springs.
inline double isotropic_ratio(const LatticeFacts& lattice) {
  if (lattice.spring_classes < 2) return 0;
  const auto anisotropy = [&](double beta, double gamma) {
    const ElasticConstants c =
        lattice.elastic_constants(constants(lattice, {0, beta, gamma, true}));
    return c.C11 - c.C12 - 2 * c.C44;
  };
  const double without = anisotropy(0, 0);
  return -(anisotropy(1, 0) - without) / (anisotropy(0, 1) - without);
}

/// Returns the ratios of equations (1) to (5); I-m uses the isotropic ratio of this lattice.
inline Ratios ratios(const LatticeFacts& lattice, Membrane membrane, double lambda) {
  Ratios ratios = calibration::ratios(membrane, lambda);
  if (membrane == Membrane::I_m) ratios.gamma = isotropic_ratio(lattice) * ratios.beta;
  return ratios;
}

inline ElasticConstants elastic_constants(const LatticeFacts& lattice, Membrane membrane,
                                          double lambda) {
  return lattice.elastic_constants(constants(lattice, ratios(lattice, membrane, lambda)));
}

/// Returns the lambda with this Poisson ratio along [100], stable or not, for a membrane that has a
/// lambda; infinity if there is none. Secant method: exact after one step for structured lattices,
/// whose elastic constants are linear in lambda.
inline double lambda(const LatticeFacts& lattice, Membrane membrane, double poisson) {
  const auto miss = [poisson](const ElasticConstants& c) {
    return c.C12 - poisson * (c.C11 + c.C12);
  };  // linear in lambda if the elastic constants are
  constexpr double rounding = 1e-13, exact = 1e-10, largest = 1e9;
  constexpr int most = 50;
  if (const ElasticConstants none = elastic_constants(lattice, membrane, 0);
      std::abs(miss(none)) < rounding * none.C11)
    return 0;
  double before = 1, now = 2, miss_before = miss(elastic_constants(lattice, membrane, before));
  for (int n = 0; n < most && std::abs(now) < largest; ++n) {
    const ElasticConstants here = elastic_constants(lattice, membrane, now);
    const double miss_now = miss(here), slope = (miss_now - miss_before) / (now - before);
    if (n > 0 && std::abs(miss_now) < exact * std::abs(here.C11)) return now;
    before = now;
    miss_before = miss_now;
    now -= miss_now / slope;
  }
  return infinity;
}

/// Returns K_v, Pa, of the volumetric energy (volumetric_cell.hpp) with which the lattice of k =
/// 1 N/m without a membrane has this Poisson ratio; infinity if there is none. With C11 and C12 of
/// the springs, K_v = (nu (C11 + C12) - C12) / (1 - 2 nu) for structured lattices. The particles of
/// a list do not follow a uniform strain, so that its springs do not stay alike; secants start
/// there.
inline double volumetric(const LatticeFacts& lattice, double poisson) {
  MaterialConstants springs = constants(lattice, {});
  const auto miss = [poisson](const ElasticConstants& c) {
    return poisson * (c.C11 + c.C12) - c.C12;
  };
  const double without = miss(lattice.elastic_constants(springs)), slope = 1 - 2 * poisson;
  double now = without / slope, before = 0, miss_before = without;
  constexpr double exact = 1e-6;
  constexpr int most = 30;
  for (int n = 0; n < most; ++n) {
    springs.volumetric = now;
    const ElasticConstants here = lattice.elastic_constants(springs);
    const double miss_now = miss(here);
    if (std::abs(miss_now) < exact * std::abs(here.C11 - here.C12)) return now;
    const double next = now - miss_now * (now - before) / (miss_now - miss_before);
    before = now;
    miss_before = miss_now;
    now = next;
  }
  return infinity;
}

/// Returns the Poisson ratio that the lattice approaches for lambda to infinity.
inline double limit(const LatticeFacts& lattice, Membrane membrane) {
  const ElasticConstants one = elastic_constants(lattice, membrane, 1e3),
                         two = elastic_constants(lattice, membrane, 2e3);
  const double C11 = two.C11 - one.C11, C12 = two.C12 - one.C12;
  return C12 / (C11 + C12);
}

/// Returns the lambda above which the lattice is stable; nothing if small positive lambda are
/// unstable.
inline std::optional<double> least_stable(const LatticeFacts& lattice, Membrane membrane) {
  constexpr double small = 1e-6;
  const auto grows = [&](double at) {
    return !lattice.is_stable(constants(lattice, ratios(lattice, membrane, at)));
  };
  double stable = small, unstable = -8;
  if (grows(stable)) return std::nullopt;
  while (stable - unstable > small) {
    const double middle = (stable + unstable) / 2;
    (grows(middle) ? unstable : stable) = middle;
  }
  return std::abs(stable) < 2 * small ? 0 : stable;
}

/// Returns whether the mirrored lattice is stable; false at the edge of stability.
inline bool is_stable(const LatticeFacts& lattice, Membrane membrane, double lambda) {
  if (!lattice.is_stable(constants(lattice, ratios(lattice, membrane, lambda)))) return false;
  if (lambda >= 0) return true;
  constexpr double edge = 1e-5;
  const std::optional<double> least = least_stable(lattice, membrane);
  return least && *least < 0 && lambda > *least + edge;
}

/// Returns the Poisson ratios for which the mirrored lattice is stable, for a membrane with a
/// lambda.
inline Reach reach(const LatticeFacts& lattice, Membrane membrane) {
  const std::optional<double> least = least_stable(lattice, membrane);
  if (!least) return {};
  const auto tidy = [](double nu) {
    return std::abs(nu) < 1e-5 ? 0 : nu;
  };  // the accuracy of the edge of stability
  const double start = tidy(elastic_constants(lattice, membrane, *least).poisson()),
               end = tidy(limit(lattice, membrane));
  return {std::min(start, end), std::max(start, end), *least < 0 || end > start};
}

/// Lists the names of the membranes with a lambda, other than `but`, for which `holds` is true.
template <class Holds>
std::string others(Membrane but, const Holds& holds) {
  std::string names;
  for (const Membrane other : with_lambda)
    if (other != but && holds(other))
      names += (names.empty() ? "" : ", ") + std::string(name(other));
  return names;
}

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(4);
  (out << ... << parts);
  return out.str();
}

/// Upper bound of the Poisson ratio of a solid and of the option. A very soft lattice may seem to
/// exceed it.
inline constexpr double largest_poisson = 0.5;

/// Returns, for a message, how the volumetric energy of the cells gives the lattice this Poisson
/// ratio; "" if it does not. `but`: the membrane that the scene has.
inline std::string reached_by_cells(const LatticeFacts& lattice, Membrane but, double poisson) {
  if (!lattice.has_cells || !(poisson > -1 && poisson < largest_poisson)) return "";
  if (poisson >= lattice.elastic_constants(constants(lattice, {})).poisson())
    return but == Membrane::none ? "" : "membrane none";
  return but == Membrane::none ? "volumetric true" : "membrane none with volumetric true";
}

/// Returns, for a message, what else gives the lattice this Poisson ratio: the membranes other than
/// `but` that are stable, and the volumetric energy.
inline std::string reached_by(const LatticeFacts& lattice, Membrane but, double poisson) {
  const bool is_listed = lattice.lengths > 0;
  // Finding the ratios of a list costs tens of solutions for all its springs.
  if (is_listed)
    return std::string("other membranes have other ratios") +
           (lattice.has_cells && but != Membrane::none
                ? "; membrane none reaches all from that of its springs to 0.5"
                : "");
  std::string names;
  for (const Membrane other : with_lambda) {
    const double found = other == but ? infinity : lambda(lattice, other, poisson);
    if (!std::isfinite(found) || !is_stable(lattice, other, found)) continue;
    const ElasticConstants c = elastic_constants(lattice, other, found);
    const bool isotropic = std::abs(2 * c.C44 / (c.C11 - c.C12) - 1) < 0.01;
    names += text(names.empty() ? "" : ", ", name(other), isotropic ? "" : " (not isotropic)");
  }
  const std::string cells = reached_by_cells(lattice, but, poisson);
  if (names.empty())
    return cells.empty() ? "no membrane of this lattice reaches it" : cells + " reaches it";
  return text(poisson, " is within the reach of ", names, cells.empty() ? "" : "; ", cells,
              cells.empty() ? "" : " reaches it too");
}

/// Returns, for a message about a Poisson ratio that a membrane cannot reach, its reach and the
/// membranes that do.
inline std::string reach_sentence(const LatticeFacts& lattice, Membrane membrane, double poisson) {
  Reach own = reach(lattice, membrane);
  if (!(own.low < own.high) || own.low >= largest_poisson)
    return text("for another lattice or membrane: none is possible with this lattice and membrane ",
                name(membrane), ", which ",
                own.low < own.high ? text("gives (", own.low, ", ", own.high,
                                          "]; a Poisson ratio is below ", largest_poisson)
                                   : "is unstable",
                "; ", reached_by(lattice, membrane, poisson));
  own.open = own.open || own.high >= largest_poisson;
  own.high = std::min(own.high, largest_poisson);
  return text("within (", own.low, ", ", own.high, own.open ? ")" : "]", ", the reach of membrane ",
              name(membrane), "; ", reached_by(lattice, membrane, poisson));
}

/// Returns, for a message about a lambda with an unstable lattice, the stable lambda and the
/// membranes that are stable with this one.
inline std::string stable_sentence(const LatticeFacts& lattice, Membrane membrane, double lambda) {
  const std::optional<double> least = least_stable(lattice, membrane);
  const std::string stable =
      others(membrane, [&](Membrane other) { return is_stable(lattice, other, lambda); });
  return (!least ? text("another membrane: ", name(membrane), " is unstable for small lambda")
                 : text(*least == 0 ? "at least " : "above ", *least, ": with less, membrane ",
                        name(membrane), " is unstable")) +
         (stable.empty() ? "; no membrane of this lattice is stable with it"
                         : text("; ", lambda, " is stable with ", stable));
}

}  // namespace hyperlattice::membranes
