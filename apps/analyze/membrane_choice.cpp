#include <analyze/elasticity.hpp>
#include <analyze/membrane_choice.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace hyperlattice {

namespace {

using calibration::Membrane;
using calibration::membrane_names;

void check_finite(const char* option, const std::optional<double>& value, Faults& faults) {
  if (value && !std::isfinite(*value))
    faults.add(option, fmt::format("{}", *value), "a finite number");
}

/// Returns the ratios of the membrane "free"; k_alpha = "infinite" clamps the heights.
calibration::Ratios free_ratios(const MembraneChoice& choice, const LatticeGeometry& geometry,
                                Faults& faults) {
  calibration::Ratios ratios{0, choice.k_beta.value_or(0), choice.k_gamma.value_or(0), false};
  if (choice.k_alpha == "infinite")
    ratios.clamped = true;
  else if (choice.k_alpha) {
    const char* end = choice.k_alpha->data() + choice.k_alpha->size();
    const auto read = std::from_chars(choice.k_alpha->data(), end, ratios.alpha);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(ratios.alpha))
      faults.add("--k_alpha", *choice.k_alpha, "a finite number, or infinite");
  }
  if (ratios.gamma != 0 && geometry.spring_classes < 2)
    faults.add("--k_gamma", fmt::format("{}", ratios.gamma),
               "none: this lattice has one class of springs, that of k_beta");
  return ratios;
}

/// Returns the given lambda, or the lambda of the given Poisson ratio.
double lambda_of(const MembraneChoice& choice, Membrane membrane, const LatticeGeometry& geometry,
                 Faults& faults) {
  if (choice.poisson.has_value() == choice.lambda.has_value()) {
    faults.add(choice.poisson ? "--lambda" : "--poisson",
               choice.lambda ? fmt::format("{}", *choice.lambda) : "",
               choice.poisson ? "one of --poisson and --lambda: each follows from the other"
                              : "a Poisson ratio, or --lambda in its place");
    return 0;
  }
  if (choice.lambda) return *choice.lambda;
  const double lambda = *lambda_for(geometry, membrane, *choice.poisson);
  const auto within = reach(geometry, membrane);
  constexpr double rounding = 1e-9;  // rounding error of the ends of the range
  const double high = within->open ? *choice.poisson : *choice.poisson - rounding;
  if (!std::isfinite(lambda) || !within->holds(high))
    faults.add("--poisson", fmt::format("{}", *choice.poisson),
               reach_sentence(geometry, membrane, *choice.poisson));
  return lambda;
}

}  // namespace

std::optional<Membrane> membrane_named(const std::string& name, Faults& faults) {
  const auto found = std::find(std::begin(membrane_names), std::end(membrane_names), name);
  if (found != std::end(membrane_names))
    return static_cast<Membrane>(found - std::begin(membrane_names));
  const std::vector<std::string> names(std::begin(membrane_names), std::end(membrane_names));
  const std::string near = nearest(name, names);
  faults.add("--membrane", name,
             fmt::format("one of {}{}", fmt::join(names, ", "),
                         near.empty() ? "" : "; did you mean '" + near + "'?"));
  return std::nullopt;
}

ChosenMembrane resolve(const MembraneChoice& choice, const LatticeGeometry& geometry) {
  Faults faults;
  const std::optional<Membrane> membrane = membrane_named(choice.membrane, faults);
  check_finite("--poisson", choice.poisson, faults);
  check_finite("--lambda", choice.lambda, faults);
  check_finite("--k_beta", choice.k_beta, faults);
  check_finite("--k_gamma", choice.k_gamma, faults);
  faults.throw_if_any();

  ChosenMembrane chosen;
  chosen.membrane = *membrane;
  const bool with_lambda = has_lambda(*membrane);
  if (!with_lambda && choice.lambda)
    faults.add("--lambda", fmt::format("{}", *choice.lambda),
               "none: only membranes I, II, III, IV and I-m have one");
  if (*membrane != Membrane::free)
    for (const auto& [option, given] : {std::pair{"--k_alpha", choice.k_alpha.has_value()},
                                        {"--k_beta", choice.k_beta.has_value()},
                                        {"--k_gamma", choice.k_gamma.has_value()}})
      if (given)
        faults.add(option, "", "none, or --membrane free: the other membranes set it themselves");

  if (with_lambda) {
    chosen.lambda = lambda_of(choice, *membrane, geometry, faults);
    chosen.ratios = ratios_of(geometry, *membrane, *chosen.lambda);
  } else if (*membrane == Membrane::free) {
    chosen.ratios = free_ratios(choice, geometry, faults);
  }
  if (!with_lambda && choice.poisson && faults.empty()) {
    const double poisson = elasticity(with_ratios(geometry, chosen.ratios)).poisson_bulk();
    const bool differs = std::abs(poisson - *choice.poisson) > 1e-4;
    const LatticeFacts facts = facts_of(geometry);
    const double lowest = geometry.listed ? poisson : -1;  // a list has no K_v below zero
    const bool reaches = *membrane == Membrane::none && facts.has_cells &&
                         *choice.poisson > lowest && *choice.poisson < membranes::largest_poisson;
    if (differs && reaches)
      chosen.volumetric = geometry.spacing * membranes::volumetric(facts, *choice.poisson);
    else if (differs)
      faults.add(
          "--poisson", fmt::format("{}", *choice.poisson),
          fmt::format("none, or {:.6g}: that is what these springs have along [100]", poisson));
  }
  faults.throw_if_any();
  return chosen;
}

SpringLattice lattice_of(const ChosenMembrane& chosen, const LatticeGeometry& geometry) {
  return with_ratios(geometry, chosen.ratios, chosen.volumetric);
}

Json chosen_json(const ChosenMembrane& chosen) {
  Json json = {{"membrane", membrane_names[static_cast<std::size_t>(chosen.membrane)]}};
  if (chosen.lambda) json["lambda"] = *chosen.lambda;
  json["k_alpha"] = chosen.ratios.clamped ? Json("infinite") : Json(chosen.ratios.alpha);
  json["k_beta"] = chosen.ratios.beta;
  json["k_gamma"] = chosen.ratios.gamma;
  if (chosen.volumetric != 0) json["volumetric"] = chosen.volumetric;
  return json;
}

}  // namespace hyperlattice
