#include <analyze/calibrate.hpp>
#include <analyze/elasticity.hpp>
#include <analyze/paper_fit.hpp>
#include <model/build.hpp>
#include <model/homogenise.hpp>
#include <model/stability.hpp>

#include <spdlog/fmt/fmt.h>

#include <utility>

namespace hyperlattice {

namespace {

void check_positive(const char* option, const std::optional<double>& value, Faults& faults) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    faults.add(option, fmt::format("{}", *value), "a positive, finite number");
}

/// Returns whether to use the paper's polynomials. Adds a fault if they do not hold for this
/// choice.
bool by_paper(const CalibrationChoice& choice, const LatticeGeometry& geometry, Faults& faults) {
  if (choice.parameters == "closed_form") return false;
  if (choice.parameters != "paper") {
    const std::string near = nearest(choice.parameters, {"closed_form", "paper"});
    faults.add("--parameters", choice.parameters,
               "closed_form or paper" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
    return false;
  }
  Faults unknown;  // reported by resolve()
  const auto membrane = membrane_named(choice.membrane.membrane, unknown);
  if (!membrane) return false;
  if (const std::string instead = paper_fit::instead(geometry, *membrane); !instead.empty()) {
    faults.add("--parameters", choice.parameters, instead);
    return false;
  }
  constexpr const char* takes_it = "; --parameters closed_form takes it";
  if (const std::optional<double> nu = choice.membrane.poisson)
    if (const std::string range = paper_fit::range_of_poisson(*nu); !range.empty())
      faults.add("--poisson", fmt::format("{}", *nu),
                 range + (calibration::reach(*membrane).holds(*nu)
                              ? takes_it
                              : "; " + reach_sentence(geometry, *membrane, *nu)));
  if (const std::optional<double> lambda = choice.membrane.lambda)
    if (const std::string range = paper_fit::range_of_lambda(*lambda); !range.empty())
      faults.add("--lambda", fmt::format("{}", *lambda),
                 range + (is_stable(geometry, *membrane, *lambda)
                              ? takes_it
                              : "; " + stable_sentence(geometry, *membrane, *lambda)));
  return true;
}

/// Adds a fault if the lattice is unstable. resolve() has checked a Poisson ratio already.
void check_stable(const CalibrationChoice& choice, const ChosenMembrane& chosen,
                  const LatticeGeometry& geometry, Faults& faults) {
  if (choice.membrane.lambda && !is_stable(geometry, chosen.membrane, *chosen.lambda))
    faults.add("--lambda", fmt::format("{}", *chosen.lambda),
               stable_sentence(geometry, chosen.membrane, *chosen.lambda));
  if (chosen.membrane == calibration::Membrane::free && geometry.listed) {
    if (!facts_of(geometry).is_stable(with_ratios(geometry, chosen.ratios).constants()))
      faults.add("--membrane", choice.membrane.membrane,
                 "springs of positive stiffness: no more is known of a listed lattice");
  } else if (chosen.membrane == calibration::Membrane::free)
    if (const auto unstable =
            find_instability(with_ratios(geometry, chosen.ratios).endless(), Sector::mirrored))
      faults.add("--membrane", choice.membrane.membrane,
                 "springs that make a stable lattice; with these, " + describe(*unstable));
}

}  // namespace

ElasticPair elastic_pair(const LatticeGeometry& geometry, const calibration::Ratios& ratios,
                         double volumetric) {
  const LatticeElasticity own = elasticity(with_ratios(geometry, ratios, volumetric));
  return {own.poisson_bulk(), own.young() / elasticity(with_ratios(geometry, {})).young()};
}

std::optional<ElasticPair> affine_pair(const LatticeGeometry& geometry,
                                       const calibration::Ratios& ratios) {
  if (!geometry.listed) return std::nullopt;
  const auto constants = [&](const calibration::Ratios& r) {
    return strained_alike(*geometry.listed, geometry.volume, geometry.membrane_distance,
                          with_ratios(geometry, r).constants());
  };
  return ElasticPair{constants(ratios).poisson(),
                     constants(ratios).young() / constants({}).young()};
}

Calibration calibrate(const CalibrationChoice& choice, const LatticeGeometry& geometry) {
  Faults faults;
  check_positive("--young", choice.young, faults);
  check_positive("--spacing", choice.spacing, faults);
  if (choice.spacing && !choice.young)
    faults.add("--spacing", fmt::format("{}", *choice.spacing),
               "--young with it: k follows from both");
  const std::size_t before = faults.size();
  const bool paper = by_paper(choice, geometry, faults);
  MembraneChoice membrane = choice.membrane;
  if (paper && membrane.poisson && !membrane.lambda)
    membrane.lambda = calibration::paper_lambda(*std::exchange(membrane.poisson, std::nullopt));

  Calibration found;
  if (faults.size() == before) try {
      found.chosen = resolve(membrane, geometry);
      check_stable(choice, found.chosen, geometry, faults);
    } catch (const InputError& error) {
      add_all(faults, error);
    }
  faults.throw_if_any();

  found.pair = found.infinite =
      elastic_pair(geometry, found.chosen.ratios, found.chosen.volumetric);
  if (paper) {
    found.pair.poisson = choice.membrane.poisson ? *choice.membrane.poisson
                                                 : paper_fit::poisson(*found.chosen.lambda);
    found.pair.modulus_ratio = calibration::paper_modulus_ratio(*found.chosen.lambda);
  }
  found.zener = elasticity(lattice_of(found.chosen, geometry)).zener();
  found.young = choice.young;
  if (choice.young) {
    found.stiffness_per_spacing =
        *choice.young / (found.pair.modulus_ratio * elasticity(with_ratios(geometry, {})).young());
    if (choice.spacing) found.base_stiffness = *found.stiffness_per_spacing * *choice.spacing;
  }
  return found;
}

}  // namespace hyperlattice
