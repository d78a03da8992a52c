// A solid whose springs have a force that the scene writes as an expression:
//   "force": "stiffness * elongation * exp(-strain / weak)", "constants": ["weak = 0.01"]
// The stiffness k of each spring follows from Young's modulus and the Poisson ratio, as that of
// elastic springs, so the force at rest must have the slope k. The tangent comes from automatic
// differentiation, the energy from the integral of the force without its rate, or from "energy".
// Springs whose force grows with the rate f = k (u + tau du/dt) at rest have the stable step of
// Kelvin and Voigt: dt^2 + 2 tau dt < dt_c^2.
#include "expression.hpp"

#include "spring_force.hpp"

#include <quantities/constants.hpp>

#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

#include <algorithm>
#include <cmath>

namespace {
using namespace hyperlattice;
using spring_expression::SpringForce;

class ExpressionSolid {
 public:
  struct Options : elastic_solid::Options {
    std::string force;
    std::optional<std::string> energy;
    std::vector<std::string> constants;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("materials.expression",
                           "Springs whose force is an expression of their elongation and its rate");
    schema.equation("f = force(u, du/dt); df/du = k at rest")
        .source(
            "the names `elongation` (m), `strain` (elongation over rest length), `rate` (m/s), "
            "`strain_rate` (1/s), `stiffness` (N/m, the k of the spring), `rest_length` (m), pi "
            "and "
            "the constants; numbers with or without a unit; the operators `+ - * / ^ < <= > >= == "
            "!= && || ?:` and the functions of loads.expression. Dimensions are checked. "
            "The energy is integrated by Gauss's rule of three points if the force is a polynomial "
            "of the elongation up to the fifth degree, or over ways below a thousandth of the "
            "length; by Gauss and Kronrod's adaptive rule otherwise")
        .restrictions(
            "the force is zero at rest and has the slope `stiffness` there, base and cross springs "
            "alike: write it with `stiffness`. A force that gives energy back when it moves in a "
            "circle, such as one that falls with the rate, is refused where it shows at rest. The "
            "stable step is that of small strains: a law that stiffens needs a smaller time_step. "
            "Springs are computed in doubles. A force without the rate is computed for eight "
            "springs at once, one with the rate spring by spring")
        .add<&Options::force>("force", "", "force of a spring, N, positive if it pulls")
        .example("\"stiffness * elongation * (1 - 20 * strain + 400 * strain^2)\"")
        .add<&Options::energy>("energy", "",
                               "stored energy of a spring, J; the integral of the force if left "
                               "out. Worth while for a force with kinks and jumps")
        .add<&Options::constants>(
            "constants", "",
            "names for quantities, such as \"weak = 0.01\"; each may use those "
            "before it")
        .fallback("[]");
    Options::declare(schema);
    return schema.check([](const Options& options, const FaultSink& faults) {
      options.check(faults);
      read(options, faults);
    });
  }

  explicit ExpressionSolid(const Options& options) : options_(options) {
    bool good = true;
    const FaultSink faults{&good, [](void* self, std::string_view, std::string_view) noexcept {
                             *static_cast<bool*>(self) = false;
                           }};
    std::optional<SpringForce> force = read(options, faults);
    if (!force) throw std::invalid_argument("force: it is no expression");
    force_.emplace(std::move(*force));
    std::string text = options.force + '\n' + options.energy.value_or("") + '\n';
    for (const std::string& constant : options.constants) text += constant + '\n';
    number_ = spring_expression::keep(text, *force_);
    if (force_->has_rate()) law = "expression";
  }

  MaterialConstants constants(const LatticeFacts& lattice) const {
    const elastic_solid::Options& elastic = options_;
    MaterialConstants constants = elastic.constants(lattice);
    constants.set_law(ExpressionLaw::Constants{static_cast<double>(number_)});
    retardation_ = 0;
    for (const Neighbour& n : lattice.neighbours) {
      const double k = constants.base_stiffness * lattice.class_stiffness[n.spring_class],
                   cross = constants.base_stiffness * constants.cross_ratio[n.spring_class];
      const Vec3 rest = lattice.spacing * combined(lattice.basis, n.dx, n.dy, n.dz);
      const double length = std::sqrt(dot(rest, rest));
      check_at_rest(k, length);
      if (cross != 0) check_at_rest(cross, std::hypot(length, lattice.membrane_distance));
    }
    if (lattice.neighbours.empty()) check_at_rest(constants.base_stiffness, lattice.spacing);
    return constants;
  }
  double stable_time_step(double elastic_step) const {
    return std::sqrt(retardation_ * retardation_ + elastic_step * elastic_step) - retardation_;
  }
  std::string_view law = "elastic_expression";  ///< "expression" if the force depends on the rate
  KernelSet kernels(const KernelChoice& choice) const {
    return force_->has_rate() ? kernels_for_processor<ExpressionLaw>(choice)
                              : kernels_for_processor<ElasticExpressionLaw>(choice);
  }

 private:
  /// Compiles the expressions. Returns nothing after faults.
  static std::optional<SpringForce> read(const Options& options, const FaultSink& faults) {
    std::vector<ExpressionName> names = spring_expression::input_names();
    if (const std::string wrong = add_constants(options.constants, names); !wrong.empty()) {
      faults.fault("constants", wrong);
      return std::nullopt;
    }
    const auto compiled = [&](std::string_view option, const std::string& text,
                              const Powers& powers, const std::string& what) {
      Expression read = compile_expression(text, names);
      std::string why = read.problem;
      if (why.empty() && read.is_condition) why = "it is a condition";
      if (why.empty() && !same(read.powers, powers)) why = "it is " + dimension_name(read.powers);
      if (!why.empty()) faults.fault(option, what + "; " + why);
      return why.empty() ? std::move(read.compiled) : std::nullopt;
    };
    auto force = compiled("force", options.force, {1, 1, -2},
                          "a force of a spring, such as stiffness * elongation");
    if (!force) return std::nullopt;
    if (!options.energy) return SpringForce{std::move(*force), std::nullopt};
    auto energy = compiled("energy", *options.energy, {2, 1, -2},
                           "an energy of a spring, such as stiffness * elongation^2 / 2");
    if (!energy) return std::nullopt;
    return SpringForce{std::move(*force), std::move(energy)};
  }

  /// Throws std::invalid_argument if a spring at rest is not that of the elastic constants, or if
  /// its energy does not belong to its force.
  void check_at_rest(double stiffness, double rest_length) const {
    constexpr double allowed = 1e-6;
    const SpringState rest{stiffness, rest_length, 0, 0, 0};
    const double unit = stiffness * rest_length;  // N
    const auto number = [](double value) { return std::to_string(value); };
    if (!(std::abs(force_->force_at(rest)) <= 1e-12 * std::abs(unit)))
      throw std::invalid_argument("force that is zero at rest, and not " +
                                  number(force_->force_at(rest)) + " N");
    const double slope = force_->tangent_at(rest) / stiffness;
    if (!(std::abs(slope - 1) <= allowed))
      throw std::invalid_argument("force with the slope stiffness at rest, and not " +
                                  number(slope) + " of it: E and nu hold for small strains");
    const double viscosity = force_->viscosity_at(rest) / stiffness;
    if (!(viscosity >= 0))
      throw std::invalid_argument("force that does not fall when the spring lengthens faster");
    retardation_ = std::max(retardation_, viscosity);
    if (force_->energy) check_energy(rest, unit);
  }

  /// Compares the energy with the integral of the force at some strains.
  void check_energy(const SpringState& rest, double unit) const {
    constexpr double allowed = 1e-6;
    const SpringForce integral{force_->force, std::nullopt};
    for (const double strain : {-1e-2, -1e-3, 1e-3, 1e-2}) {
      SpringState spring = rest;
      spring.elongation = strain * rest.rest_length;
      const double given = force_->energy_since(spring, 0),
                   found = integral.energy_since(spring, 0);
      if (!(std::abs(given - found) <=
            allowed * (std::abs(found) + 1e-6 * unit * rest.rest_length * strain * strain)))
        throw std::invalid_argument("energy that is the integral of the force; at a strain of " +
                                    std::to_string(strain) + " it is " +
                                    std::to_string(given / found) + " of it");
    }
  }

  Options options_;
  std::optional<SpringForce> force_;
  std::size_t number_ = 0;
  mutable double retardation_ = 0;  ///< largest viscosity over stiffness of a spring at rest, s
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<ExpressionSolid>(); }
