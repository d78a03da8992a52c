// The membrane of the cubic lattice as a user chooses it: by its name with a Poisson ratio or lambda, or by free ratios. Declared and checked
// here once, for materials and commands.
//
//   struct Options : MembraneOptions { ... };
//   static Schema<Options> schema() { ... add_membrane_options(schema); schema.check(check_membrane_options<Options>); ... }
#pragma once

#include <hyperlattice/calibration.hpp>
#include <hyperlattice/files.hpp>
#include <hyperlattice/options.hpp>

namespace hyperlattice {

/// Which formulas lead from the Poisson ratio to lambda, and on to the modulus.
enum class Parameters : std::uint32_t { closed_form, paper };
inline constexpr std::string_view parameters_names[] = {"closed_form", "paper"};

inline std::string_view name_of(calibration::Membrane membrane) { return calibration::membrane_names[static_cast<std::size_t>(membrane)]; }

struct MembraneOptions {
  std::optional<double> poisson, lambda;
  calibration::Membrane membrane = calibration::Membrane::none;
  std::optional<double> k_alpha = 0;  ///< absent: infinite
  double k_beta = 0, k_gamma = 0;
  Parameters parameters = Parameters::closed_form;

  bool is_named() const { return membrane != calibration::Membrane::none && membrane != calibration::Membrane::free; }

  /// Given, or from the Poisson ratio; 0 if there is none.
  double stiffness_ratio() const {
    if (lambda) return *lambda;
    if (!poisson) return 0;
    return parameters == Parameters::paper ? calibration::paper_lambda(*poisson) : calibration::lambda(membrane, *poisson);
  }

  calibration::Ratios ratios() const {
    if (membrane == calibration::Membrane::free) return {k_alpha.value_or(0), k_beta, k_gamma, !k_alpha.has_value()};
    return calibration::ratios(membrane, stiffness_ratio());
  }

  /// eta: E over that of the lattice without a membrane.
  double modulus_ratio() const {
    return parameters == Parameters::paper ? calibration::paper_modulus_ratio(stiffness_ratio()) : calibration::elasticity(ratios()).modulus_ratio();
  }

  /// Along [100]; what was given, if it was.
  double poisson_ratio() const {
    if (poisson && is_named()) return *poisson;
    return parameters == Parameters::paper ? calibration::paper_poisson(stiffness_ratio()) : calibration::elasticity(ratios()).poisson();
  }
};

/// Declares the options above.
template <class Options>
void add_membrane_options(Schema<Options>& schema) {
  schema.template add<&Options::poisson>("poisson", "", "Poisson ratio; may be left out without a membrane, with lambda, and with free ratios")
      .above(-1)
      .below(0.5)
      .template add<&Options::membrane>("membrane", "", "which springs there are in the fourth dimension; free: k_alpha, k_beta, k_gamma")
      .choices(calibration::membrane_names)
      .fallback("\"none\"")
      .template add<&Options::lambda>("lambda", "", "4D stiffness ratio, in place of poisson")
      .template add<&Options::k_alpha>("k_alpha", "", "with membrane free: stiffness over k of the spring from a particle to its own mirror copy")
      .word("infinite")
      .fallback("0")
      .template add<&Options::k_beta>("k_beta", "", "with membrane free: stiffness over k of the cross springs beside orthogonal springs")
      .fallback("0")
      .template add<&Options::k_gamma>("k_gamma", "", "with membrane free: stiffness over k of the cross springs beside diagonal springs")
      .fallback("0")
      .template add<&Options::parameters>("parameters", "",
                                          "closed_form: exact for the infinite lattice; paper: polynomials (11) and (13), for I-m only")
      .choices(parameters_names)
      .fallback("\"closed_form\"");
}

namespace detail {

/// "(-0.2, 0.25], the reach of membrane I-m".
inline std::string reach_text(calibration::Membrane membrane) {
  const calibration::Reach reach = calibration::reach(membrane);
  return "(" + short_number(reach.low) + ", " + short_number(reach.high) + (reach.open ? ")" : "]") + ", the reach of membrane " +
         std::string(name_of(membrane));
}

/// The membranes that have this Poisson ratio, as the end of a sentence.
inline std::string who_reaches(double nu) {
  using calibration::Membrane;
  std::string names;
  for (const Membrane other : {Membrane::I_m, Membrane::I, Membrane::II, Membrane::III, Membrane::IV})
    if (calibration::reach(other).holds(nu)) names.append(names.empty() ? "" : ", ").append(name_of(other));
  return names.empty() ? "; no membrane of this lattice reaches it" : "; " + short_number(nu) + " is within the reach of membrane " + names;
}

/// The same with the closed forms, where the paper's polynomials end.
inline std::string beyond_the_paper(double nu) {
  return calibration::reach(calibration::Membrane::I_m).holds(nu) ? "; parameters closed_form reach " + short_number(nu) : who_reaches(nu);
}

inline void check_poisson(const MembraneOptions& o, const FaultSink& faults) {
  using namespace calibration;
  const double nu = *o.poisson;
  if (o.parameters == Parameters::paper) {
    if (nu < paper_poisson_low || nu > paper_poisson_high)
      faults.fault("poisson", short_number(paper_poisson_low) + " to " + short_number(paper_poisson_high) +
                                  ", where the paper's polynomials were fitted" + beyond_the_paper(nu));
  } else if (!reach(o.membrane).holds(nu)) {
    faults.fault("poisson", (o.membrane == Membrane::none ? "0.25, or left out: that is what the lattice without a membrane has"
                                                          : "within " + reach_text(o.membrane)) +
                                who_reaches(nu));
  }
}

inline void check_lambda(const MembraneOptions& o, const FaultSink& faults) {
  using namespace calibration;
  if (o.parameters == Parameters::paper) {
    if (*o.lambda < 0 || *o.lambda > paper_lambda_high)
      faults.fault("lambda", "0 to " + short_number(paper_lambda_high) + ", where the paper's polynomials were fitted" +
                                 (*o.lambda > 0 ? "; parameters closed_form take any more" : ""));
  } else if (!stable(o.membrane, *o.lambda)) {
    faults.fault("lambda", (least_lambda(o.membrane) < 0 ? "above " + short_number(least_lambda(o.membrane)) : "0 or more") +
                               ": with less, membrane " + std::string(name_of(o.membrane)) + " is unstable");
  }
}

/// Free ratios say everything: what they give must be a solid, and the Poisson ratio that was given with them.
inline void check_free(const MembraneOptions& o, const FaultSink& faults) {
  const calibration::Elasticity elasticity = calibration::elasticity(o.ratios());
  if (!(elasticity.modulus_ratio() > 0)) return faults.fault("k_beta", "ratios that give a lattice with stiffness");
  if (o.poisson && std::abs(*o.poisson - elasticity.poisson()) > 1e-4)
    faults.fault("poisson", short_number(elasticity.poisson()) + ", what these ratios give along [100]; or leave poisson out");
}

}  // namespace detail

/// The cross-field check of the options above.
template <class Options>
void check_membrane_options(const Options& options, const FaultSink& faults) {
  using calibration::Membrane;
  const MembraneOptions& o = options;
  const bool free = o.membrane == Membrane::free;
  if (!free && (o.k_beta != 0 || o.k_gamma != 0 || o.k_alpha != 0.0)) faults.fault("membrane", "free, because k_alpha, k_beta or k_gamma is given");
  if (o.parameters == Parameters::paper && o.membrane != Membrane::I_m)
    faults.fault("parameters", "closed_form: the paper's polynomials are of membrane I-m");
  if (o.lambda && !o.is_named())
    faults.fault("lambda", "no lambda: only membranes I, II, III, IV and I-m have one");
  else if (o.lambda && o.poisson)
    faults.fault("lambda", "one of poisson and lambda: each follows from the other");
  else if (!o.lambda && !o.poisson && o.is_named())
    faults.fault("poisson", "a Poisson ratio, or lambda in its place");
  else if (free)
    detail::check_free(o, faults);
  else if (o.poisson)
    detail::check_poisson(o, faults);
  else if (o.lambda)
    detail::check_lambda(o, faults);
}

}  // namespace hyperlattice
