// The elastic part of a solid, shared by all laws: finds the stiffness k of the base springs and
// lambda, the stiffness of the springs into the fourth dimension over k, from Young's modulus E and
// the Poisson ratio nu. For the cubic lattice it uses closed forms of the infinite lattice
// (calibration.hpp):
//   I-m: lambda = 7 (1 - 4 nu) / (1 + 5 nu),  k = 0.4 E l / eta,
//        eta = (18/5) (1 + nu) (1 - 2 nu) / (1 + 5 nu)
// For other lattices it uses their computed elastic constants (membranes.hpp). Without a membrane
// the volumetric energy of the cells, or of the nodal volumes of a list, (volumetric_cell.hpp)
// gives every Poisson ratio above the lattice's own, and with `volumetric` those below it:
//   K_v = (nu (C11 + C12) - C12) / (1 - 2 nu) with C11, C12 of the springs; C (4 nu - 1) / (1 - 2
//   nu) for the cubic lattice, C = k / l. E is the modulus of
// one layer; every particle has the mass density * V, with V the volume of its site.
#pragma once

#include <hyperlattice/membranes.hpp>

#include <stdexcept>

namespace hyperlattice::elastic_solid {
using calibration::Membrane;
using membranes::has_lambda;
using membranes::text;

enum class Parameters : std::uint32_t { closed_form, paper };
constexpr std::string_view parameter_names[] = {"closed_form", "paper"};
enum class Stiffness : std::uint32_t { bulk, eq15 };
constexpr std::string_view stiffness_names[] = {"bulk", "eq15"};

/// Returns whether the lattice is that of calibration.hpp: 6 orthogonal springs of class 0 and 12
/// diagonal ones of class 1, all of equal stiffness.
inline bool is_cubic_of_18(const LatticeFacts& lattice) {
  const auto fits = [](const Neighbour& n) {
    return static_cast<std::uint32_t>(n.dx * n.dx + n.dy * n.dy + n.dz * n.dz) ==
           n.spring_class + 1;
  };
  return lattice.basis == cubic_basis && lattice.neighbours.size() == 9 &&
         std::all_of(lattice.neighbours.begin(), lattice.neighbours.end(), fits) &&
         lattice.class_stiffness[0] == 1 && lattice.class_stiffness[1] == 1 &&
         lattice.membrane_distance == lattice.spacing;
}

/// Ratios of the springs into the fourth dimension, and properties of the infinite lattice with
/// them for k = 1 N/m.
struct Choice {
  calibration::Ratios ratios;
  double poisson = 0, modulus_ratio = 0;
  double volumetric = 0;  ///< K_v, Pa
};
/// Options of a material that is elastic at small strain, and the constants that they give on a
/// lattice. A material's own Options derive from them.
struct Options {
  double young = 0, density = 0;
  std::optional<double> poisson, lambda;
  Membrane membrane = Membrane::none;
  bool volumetric = false;
  std::optional<double> k_alpha;  // absent: infinitely stiff
  double k_beta = 0, k_gamma = 0;
  Parameters parameters = Parameters::closed_form;
  Stiffness stiffness = Stiffness::bulk;

  /// Adds these options and their checks to a schema.
  template <class Of>
  static Schema<Of>& declare(Schema<Of>& schema) {
    return schema.template add<&Options::young>("young", "Pa", "Young's modulus of the body")
        .positive()
        .example("\"10 GPa\"")
        .template add<&Options::poisson>(
            "poisson", "",
            "Poisson ratio; may be left out without a membrane, with lambda, and with free ratios. "
            "Without a membrane, the volumetric energy of cubic cells, or of the nodal volumes of "
            "a list, gives a value above the lattice's own (1/4 in the cubic lattice), exactly "
            "isotropic for cells, and with 3 degrees of freedom")
        .above(-1)
        .below(0.5)
        .template add<&Options::density>("density", "kg/m3", "mass density")
        .positive()
        .template add<&Options::membrane>(
            "membrane", "",
            "which springs there are in the fourth dimension; free: k_alpha, k_beta, k_gamma")
        .choices(calibration::membrane_names)
        .fallback("\"none\"")
        .template add<&Options::volumetric>(
            "volumetric", "",
            "without a membrane, the volumetric energy of the cells also gives Poisson ratios "
            "below "
            "the lattice's own, by K_v below zero; only in bodies without failure")
        .fallback("false")
        .template add<&Options::lambda>("lambda", "", "4D stiffness ratio, in place of poisson")
        .template add<&Options::k_alpha>("k_alpha", "",
                                         "with membrane free: stiffness over k of the spring from "
                                         "a particle to its own mirror copy")
        .word("infinite")
        .fallback("0")
        .template add<&Options::k_beta>(
            "k_beta", "",
            "with membrane free: stiffness over k of the cross springs beside springs of the "
            "lattice's first class: orthogonal ones")
        .fallback("0")
        .template add<&Options::k_gamma>(
            "k_gamma", "",
            "with membrane free: stiffness over k of the cross springs beside springs of the "
            "second class: diagonal ones")
        .fallback("0")
        .template add<&Options::parameters>(
            "parameters", "",
            "closed_form: exact for the infinite lattice; paper: polynomials (11) and (13), for "
            "I-m in the simple cubic lattice only")
        .choices(parameter_names)
        .fallback("\"closed_form\"")
        .template add<&Options::stiffness>("stiffness", "",
                                           "bulk: k of the infinite lattice; eq15: equation (15) "
                                           "with the springs that the body has")
        .choices(stiffness_names)
        .fallback("\"bulk\"")
        .check([](const Of& options, const FaultSink& faults) { options.check(faults); });
  }

  /// Returns the material's constants. Throws std::invalid_argument, with a sentence whose first
  /// word is an option's name, if the lattice cannot reach the requested values.
  MaterialConstants constants(const LatticeFacts& lattice) const {
    const bool cubic = is_cubic_of_18(lattice);
    if (parameters == Parameters::paper && !cubic)
      throw std::invalid_argument(
          "parameters closed_form: the paper's polynomials are of the simple cubic lattice");
    Choice choice = cubic ? choose_in_closed_form(lattice) : choose(lattice);
    if (needs_volumetric(choice.poisson)) add_volumetric(lattice, choice);
    if (!(choice.modulus_ratio > 0))
      throw std::invalid_argument("these ratios give a lattice without stiffness");
    check_poisson(lattice, choice.poisson);

    MaterialConstants constants = membranes::constants(lattice, choice.ratios);
    constants.density = density;
    constants.base_stiffness = base_stiffness(lattice, choice, cubic);
    constants.volumetric = choice.volumetric * constants.base_stiffness;
    constants.clamped = choice.ratios.clamped && constants.has_cross_springs();
    return constants;
  }

  /// Checks the options against each other.
  void check(const FaultSink& faults) const {
    const bool has_ratios = k_beta != 0 || k_gamma != 0 || k_alpha != 0.0;
    if (membrane != Membrane::free && has_ratios)
      faults.fault("membrane", "free, because k_alpha, k_beta or k_gamma is given");
    if (poisson && *poisson > largest)
      faults.fault("poisson",
                   "at most 0.499999: nearer to 1/2 the resistance to changes of volume leaves no "
                   "digits for that to changes of shape");
    if (volumetric && membrane != Membrane::none)
      faults.fault("volumetric", "false: only a solid without a membrane takes it");
    if (parameters == Parameters::paper && membrane != Membrane::I_m)
      faults.fault("parameters", "closed_form: the paper's polynomials are of membrane I-m");
    if (lambda && (membrane == Membrane::none || membrane == Membrane::free))
      faults.fault("lambda", "no lambda: only membranes I, II, III, IV and I-m have one");
    else if (lambda && poisson)
      faults.fault("lambda", "one of poisson and lambda: each follows from the other");
    else if (!lambda && !poisson && membrane != Membrane::none && membrane != Membrane::free)
      faults.fault("poisson", "a Poisson ratio, or lambda in its place");
    else if (poisson && parameters == Parameters::paper &&
             (*poisson < calibration::paper_poisson_low ||
              *poisson > calibration::paper_poisson_high))
      faults.fault("poisson",
                   text(calibration::paper_poisson_low, " to ", calibration::paper_poisson_high,
                        ", where the paper's polynomials were fitted"));
  }

 private:
  /// The largest Poisson ratio: the bulk modulus is then 5e5 times the shear modulus.
  static constexpr double largest = 0.499999;
  /// Difference of Poisson ratios that counts as none.
  static constexpr double tolerance = 1e-4;

  calibration::Ratios free_ratios() const {
    return {k_alpha.value_or(0), k_beta, k_gamma, !k_alpha.has_value()};
  }

  /// Returns the choice for the cubic lattice.
  Choice choose_in_closed_form(const LatticeFacts& lattice) const {
    if (!has_lambda(membrane)) return of_cubic(free_ratios());
    const bool paper = parameters == Parameters::paper;
    const double ratio = lambda  ? *lambda
                         : paper ? calibration::paper_lambda(*poisson)
                                 : calibration::lambda(membrane, *poisson);
    check_reach(lattice, ratio);
    Choice choice = of_cubic(calibration::ratios(membrane, ratio));
    if (paper) choice.modulus_ratio = calibration::paper_modulus_ratio(ratio);
    return choice;
  }

  static Choice of_cubic(const calibration::Ratios& ratios) {
    const calibration::Elasticity elasticity = calibration::elasticity(ratios);
    return {ratios, elasticity.poisson(), elasticity.modulus_ratio()};
  }

  /// Returns the choice for any lattice.
  Choice choose(const LatticeFacts& lattice) const {
    Choice choice{free_ratios(), 0, 0};
    if (has_lambda(membrane)) {
      const double ratio = lambda ? *lambda : membranes::lambda(lattice, membrane, *poisson);
      check_reach(lattice, ratio);
      choice.ratios = membranes::ratios(lattice, membrane, ratio);
    } else if (k_gamma != 0 && lattice.spring_classes < 2) {
      throw std::invalid_argument(
          "k_gamma 0: this lattice has one class of springs, that of k_beta");
    }
    const ElasticConstants own =
        lattice.elastic_constants(membranes::constants(lattice, choice.ratios));
    choice.poisson = own.poisson();
    choice.modulus_ratio =
        own.young() / lattice.elastic_constants(membranes::constants(lattice, {})).young();
    return choice;
  }

  /// Returns whether the cells must have a volumetric energy. `own`: the springs' Poisson ratio.
  bool needs_volumetric(double own) const {
    return membrane == Membrane::none && poisson && std::abs(*poisson - own) > tolerance &&
           (volumetric || *poisson > own);
  }

  /// Gives the choice the volumetric energy that its Poisson ratio needs.
  void add_volumetric(const LatticeFacts& lattice, Choice& choice) const {
    if (!lattice.has_cells) return;
    MaterialConstants constants = membranes::constants(lattice, choice.ratios);
    const ElasticConstants springs = lattice.elastic_constants(constants);
    choice.volumetric = constants.volumetric = membranes::volumetric(lattice, *poisson);
    if (!std::isfinite(choice.volumetric))
      throw std::invalid_argument(text("poisson ", choice.poisson,
                                       ", or left out: the sample of this lattice gives no "
                                       "volumetric energy for ",
                                       *poisson));
    const ElasticConstants own = lattice.elastic_constants(constants);
    choice.poisson = own.poisson();
    choice.modulus_ratio *= own.young() / springs.young();
  }

  /// Checks the Poisson ratio for a membrane with a lambda: it must give a stable lattice, unless
  /// the scene accepts unstable ones.
  void check_reach(const LatticeFacts& lattice, double ratio) const {
    if (std::isfinite(ratio) &&
        (lattice.allow_unstable || membranes::is_stable(lattice, membrane, ratio)))
      return;
    throw std::invalid_argument(
        lambda ? "lambda " + membranes::stable_sentence(lattice, membrane, ratio)
               : "poisson " + membranes::reach_sentence(lattice, membrane, *poisson));
  }

  /// Checks that the Poisson ratio equals that of a membrane without a lambda, which is fixed.
  void check_poisson(const LatticeFacts& lattice, double own) const {
    if (!poisson || has_lambda(membrane) || std::abs(*poisson - own) <= tolerance) return;
    if (own >= membranes::largest_poisson)
      throw std::invalid_argument(
          text("poisson left out: none is possible with this lattice and membrane ",
               membranes::name(membrane), ", which gives ", own, "; a Poisson ratio is below ",
               membranes::largest_poisson));
    if (membrane == Membrane::free)
      throw std::invalid_argument(
          text("poisson ", own, " along [100], which these ratios give; or leave poisson out"));
    throw std::invalid_argument(
        text("poisson ", own, ", or left out: that is what the lattice without a membrane has; ",
             membranes::reached_by(lattice, membrane, *poisson),
             lattice.lengths > 0 ? "; a list of springs reaches only larger ones otherwise"
             : lattice.has_cells
                 ? ", in a body without failure"
                 : "; other ratios need the volumetric energy of cubic cells, whose corners the "
                   "particles of this lattice are not"));
  }

  double base_stiffness(const LatticeFacts& lattice, const Choice& choice, bool cubic) const {
    if (stiffness == Stiffness::eq15) {
      if (lattice.squared_lengths == 0)
        throw std::invalid_argument("stiffness eq15 needs a body that has springs");
      const double volume = static_cast<double>(lattice.particles) * lattice.site_volume;
      return calibration::stiffness_eq15(young, volume, lattice.squared_lengths,
                                         choice.modulus_ratio);
    }
    if (cubic) return calibration::stiffness_bulk(young, lattice.spacing, choice.modulus_ratio);
    return young /
           (choice.modulus_ratio *
            lattice.elastic_constants(membranes::constants(lattice, {})).young());  // for k = 1 N/m
  }
};

}  // namespace hyperlattice::elastic_solid
