// A linear elastic solid: from Young's modulus E and the Poisson ratio nu to the stiffness k of the base springs and lambda, the stiffness of
// the springs in the fourth dimension relative to k. Closed forms of the infinite cubic lattice (hyperlattice/calibration.hpp):
//   I-m: lambda = 7 (1 - 4 nu) / (1 + 5 nu),  k = 0.4 E l / eta,  eta = (18/5) (1 + nu) (1 - 2 nu) / (1 + 5 nu)
// E is the modulus of one layer, and every particle has the mass density * l^3.
#include <hyperlattice/calibration.hpp>
#include <hyperlattice/kernels/choose.hpp>

#include <locale>
#include <sstream>
#include <stdexcept>

namespace {
using namespace hyperlattice;
using calibration::Membrane;

enum class Parameters : std::uint32_t { closed_form, paper };
constexpr std::string_view parameter_names[] = {"closed_form", "paper"};
enum class Stiffness : std::uint32_t { bulk, eq15 };
constexpr std::string_view stiffness_names[] = {"bulk", "eq15"};

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << parts);
  return out.str();
}

std::string_view name(Membrane membrane) { return calibration::membrane_names[static_cast<std::size_t>(membrane)]; }

class Elastic {
 public:
  struct Options {
    double young = 0, density = 0;
    std::optional<double> poisson, lambda;
    Membrane membrane = Membrane::none;
    std::optional<double> k_alpha;  // absent: infinite
    double k_beta = 0, k_gamma = 0;
    Parameters parameters = Parameters::closed_form;
    Stiffness stiffness = Stiffness::bulk;
  };

  static constexpr std::string_view law = "elastic";

  static Schema<Options> schema() {
    return Schema<Options>("materials.elastic", "Linear elastic springs, from Young's modulus and the Poisson ratio")
        .equation("f = k u; k = 0.4 E l / eta(lambda); I-m: lambda = 7 (1 - 4 nu) / (1 + 5 nu)")
        .source("Zhao 2017, equations (1) to (5), (10) to (15), (31); closed forms of the infinite lattice")
        .restrictions(
            "the cubic lattice; a Poisson ratio within the membrane's reach: I (-0.212, 0.25], II (-0.5, 0.25], I-m (-0.2, 0.25], III (0, 0.267), "
            "IV (0, 0.333), none 0.25. Only I-m is isotropic; for the others E and nu hold along [100]")
        .add<&Options::young>("young", "Pa", "Young's modulus of the body")
        .positive()
        .add<&Options::poisson>("poisson", "", "Poisson ratio; may be left out without a membrane, with lambda, and with free ratios")
        .above(-1)
        .below(0.5)
        .add<&Options::density>("density", "kg/m3", "mass density")
        .positive()
        .add<&Options::membrane>("membrane", "", "which springs there are in the fourth dimension; free: k_alpha, k_beta, k_gamma")
        .choices(calibration::membrane_names)
        .fallback("\"none\"")
        .add<&Options::lambda>("lambda", "", "4D stiffness ratio, in place of poisson")
        .add<&Options::k_alpha>("k_alpha", "", "with membrane free: stiffness over k of the spring from a particle to its own mirror copy")
        .word("infinite")
        .fallback("0")
        .add<&Options::k_beta>("k_beta", "", "with membrane free: stiffness over k of the cross springs beside orthogonal springs")
        .fallback("0")
        .add<&Options::k_gamma>("k_gamma", "", "with membrane free: stiffness over k of the cross springs beside diagonal springs")
        .fallback("0")
        .add<&Options::parameters>("parameters", "", "closed_form: exact for the infinite lattice; paper: polynomials (11) and (13), for I-m only")
        .choices(parameter_names)
        .fallback("\"closed_form\"")
        .add<&Options::stiffness>("stiffness", "", "bulk: k of the infinite lattice; eq15: equation (15) with the springs that the body has")
        .choices(stiffness_names)
        .fallback("\"bulk\"")
        .check(check);
  }

  explicit Elastic(const Options& options) : o_(options) {}

  MaterialConstants constants(const LatticeFacts& lattice) const {
    if (lattice.spring_classes != 2 || lattice.neighbours.size() != 9 || lattice.membrane_distance != lattice.spacing)
      throw std::invalid_argument("materials.elastic knows the cubic lattice of 18 neighbours only");
    const calibration::Ratios ratios = this->ratios();
    const calibration::Elasticity elasticity = calibration::elasticity(ratios);
    const double eta = o_.parameters == Parameters::paper ? calibration::paper_modulus_ratio(lambda()) : elasticity.modulus_ratio();
    if (o_.membrane == Membrane::free && !(eta > 0)) throw std::invalid_argument("these ratios give a lattice without stiffness");
    if (o_.membrane == Membrane::free && o_.poisson && std::abs(*o_.poisson - elasticity.poisson()) > 1e-4)
      throw std::invalid_argument(
          text("poisson ", *o_.poisson, " does not fit these ratios: they give ", elasticity.poisson(), " along [100]; leave poisson out"));

    MaterialConstants constants;
    constants.density = o_.density;
    constants.base_stiffness = stiffness(lattice, eta);
    constants.cross_ratio[0] = ratios.beta;
    constants.cross_ratio[1] = ratios.gamma;
    constants.alpha_ratio = ratios.clamped ? 0 : ratios.alpha;
    constants.clamped = ratios.clamped && constants.has_cross_springs();
    return constants;
  }

  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }

 private:
  calibration::Ratios ratios() const {
    if (o_.membrane == Membrane::free) return {o_.k_alpha.value_or(0), o_.k_beta, o_.k_gamma, !o_.k_alpha.has_value()};
    return calibration::ratios(o_.membrane, lambda());
  }

  double lambda() const {
    if (o_.lambda) return *o_.lambda;
    if (!o_.poisson) return 0;
    return o_.parameters == Parameters::paper ? calibration::paper_lambda(*o_.poisson) : calibration::lambda(o_.membrane, *o_.poisson);
  }

  double stiffness(const LatticeFacts& lattice, double eta) const {
    const double l = lattice.spacing;
    if (o_.stiffness == Stiffness::bulk) return calibration::stiffness_bulk(o_.young, l, eta);
    const double squares = l * l * (static_cast<double>(lattice.springs[0]) + 2 * static_cast<double>(lattice.springs[1]));
    if (squares == 0) throw std::invalid_argument("stiffness eq15 needs a body that has springs");
    return calibration::stiffness_eq15(o_.young, static_cast<double>(lattice.particles) * lattice.site_volume, squares, eta);
  }

  static void check(const Options& o, const FaultSink& faults) {
    const bool has_ratios = o.k_beta != 0 || o.k_gamma != 0 || o.k_alpha != 0.0;
    if (o.membrane != Membrane::free && has_ratios) faults.fault("membrane", "free, because k_alpha, k_beta or k_gamma is given");
    if (o.parameters == Parameters::paper && o.membrane != Membrane::I_m)
      faults.fault("parameters", "closed_form: the paper's polynomials are of membrane I-m");
    if (o.lambda && (o.membrane == Membrane::none || o.membrane == Membrane::free))
      faults.fault("lambda", "no lambda: only membranes I, II, III, IV and I-m have one");
    else if (o.lambda && o.poisson)
      faults.fault("lambda", "one of poisson and lambda: each follows from the other");
    else if (!o.lambda && !o.poisson && o.membrane != Membrane::none && o.membrane != Membrane::free)
      faults.fault("poisson", "a Poisson ratio, or lambda in its place");
    else if (o.poisson && o.membrane != Membrane::free)
      check_reach(o, faults);
    else if (o.lambda && *o.lambda <= least_lambda(o.membrane))
      faults.fault("lambda", text("above ", least_lambda(o.membrane), ": with less, membrane ", name(o.membrane), " is unstable"));
  }

  /// Stable for larger lambda only; 0 itself is the 3D lattice.
  static double least_lambda(Membrane membrane) {
    return membrane == Membrane::III ? -1.5 : membrane == Membrane::IV ? -2.0 : -std::numeric_limits<double>::min();
  }

  static void check_reach(const Options& o, const FaultSink& faults) {
    const double nu = *o.poisson;
    if (o.parameters == Parameters::paper) {
      if (nu < calibration::paper_poisson_low || nu > calibration::paper_poisson_high)
        faults.fault("poisson",
                     text(calibration::paper_poisson_low, " to ", calibration::paper_poisson_high, ", where the paper's polynomials were fitted"));
      return;
    }
    const calibration::Reach reach = calibration::reach(o.membrane);
    if (reach.holds(nu)) return;
    std::string others;
    for (const Membrane other : {Membrane::I_m, Membrane::I, Membrane::II, Membrane::III, Membrane::IV})
      if (calibration::reach(other).holds(nu)) others += (others.empty() ? "" : ", ") + std::string(name(other));
    const std::string within = o.membrane == Membrane::none ? "0.25, or left out: that is what the lattice without a membrane has"
                                                            : text("within (", reach.low, ", ", reach.high, reach.open ? ")" : "]",
                                                                   ", the reach of membrane ", name(o.membrane));
    faults.fault("poisson", within + (others.empty() ? "; no membrane of this lattice reaches it"
                                                     : text("; ", nu, " is within the reach of membrane ", others)));
  }

  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Elastic>(); }
