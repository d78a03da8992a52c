// hyperlattice calibrate: stiffnesses from E and nu and back, in closed form, by the paper's
// polynomials, or measured on a cube; figure 2.
#include "commands.hpp"

#include <analyze/curve_family.hpp>
#include <analyze/load_lattice.hpp>
#include <base/gnuplot.hpp>
#include <base/named_file.hpp>
#include <run/output_file.hpp>

#include <nlohmann/json.hpp>

#include <iostream>
#include <sstream>
#include <tuple>

namespace hyperlattice {
namespace {

struct Arguments {
  LatticeArguments lattice;
  CalibrationChoice choice;
  std::optional<int> measure;
  std::optional<double> strain;
  std::optional<std::tuple<double, double, int>> curve;
  std::string each, plot;
  ThreadArgument threads;
  bool json = false;

  VirtualTest::Options virtual_test() const {
    VirtualTest::Options options;
    options.lattice = lattice.lattice;
    options.particles = measure.value_or(options.particles);
    options.strain = strain.value_or(options.strain);
    options.threads = threads.count();
    return options;
  }
};

/// Throws InputError if the arguments contradict each other.
void check(const Arguments& a) {
  Faults faults;
  constexpr int least = 3, most = 500;
  if (a.measure && (*a.measure < least || *a.measure > most))
    faults.add("--measure", std::to_string(*a.measure),
               "particles along an edge: " + std::to_string(least) + " to " + std::to_string(most));
  if (a.strain && !a.measure)
    faults.add("--strain", "", "--measure with it: that is the strain of the test");
  if (a.strain && !(std::abs(*a.strain) <= 0.1 && std::abs(*a.strain) >= 1e-9))
    faults.add("--strain", CLI::detail::to_string(*a.strain),
               "1e-9 to 0.1, positive in compression, negative in tension");
  if (!a.each.empty() && !a.curve)
    faults.add("--each", a.each, "--curve with it: one for each value");
  if (!a.each.empty() && a.measure) faults.add("--each", a.each, "none together with --measure");
  if (const auto equals = a.each.find('=');
      !a.each.empty() &&
      (equals == std::string::npos || equals == 0 || equals + 1 == a.each.size()))
    faults.add("--each", a.each,
               "an option of the lattice with several values, such as coordination=8.4,13.2");
  if (!a.plot.empty() && !a.curve)
    faults.add("--plot", a.plot, "--curve with it: that is what is drawn");
  if (!a.plot.empty()) check_output_file({"--plot", a.plot, {".svg"}}, a.lattice.files(), faults);
  faults.throw_if_any();
}

int calibrate_curve(const Arguments& a, Host& host, const LatticeGeometry& geometry) {
  const auto& [from, to, points] = *a.curve;
  const CurveChoice choice{from, to, points};
  const VirtualTest::Options options = a.virtual_test();
  check_curve(choice, a.choice, geometry);
  std::optional<VirtualTest> virtual_test;
  if (a.measure) virtual_test.emplace(host, bundled::virtual_test, options);
  const Curve curve =
      calibration_curve(choice, a.choice, geometry, virtual_test ? &*virtual_test : nullptr);
  if (!a.plot.empty())
    write_named_file(a.plot, svg_picture(a.plot, curve_script(curve, options), 1000, 460));
  Json json = {{"lattice", a.lattice.lattice}};
  json.update(curve_json(curve, options));
  std::cout << (a.json ? json_text(json) : curve_text(curve, options)) << std::flush;
  return exit_done;
}

/// Computes a curve for each value of one of the lattice's options.
int calibrate_family(const Arguments& a, Host& host) {
  const auto& [from, to, points] = *a.curve;
  const CurveChoice choice{from, to, points};
  const auto equals = a.each.find('=');
  CurveFamily family{a.each.substr(0, equals), {}};
  std::stringstream values(a.each.substr(equals + 1));
  for (std::string value; std::getline(values, value, ',');) {
    std::vector<std::string> options = a.lattice.options;
    options.push_back(family.option + "=" + value);
    family.members.push_back(
        {value, calibration_curve(choice, a.choice, load_lattice(host, a.lattice.lattice, options),
                                  nullptr)});
  }
  if (!a.plot.empty())
    write_named_file(a.plot, svg_picture(a.plot, family_script(family), 640, 460));
  Json json = {{"lattice", a.lattice.lattice}};
  json.update(family_json(family, a.virtual_test()));
  std::cout << (a.json ? json_text(json) : family_text(family)) << std::flush;
  return exit_done;
}

int calibrate(Arguments a) {
  check(a);
  a.choice.membrane = a.lattice.membrane;
  Host host;
  if (!a.each.empty()) return calibrate_family(a, host);
  const LatticeGeometry geometry = load_lattice(host, a.lattice.lattice, a.lattice.options);
  if (geometry.listed && a.measure)
    throw InputError({{"--measure", std::to_string(*a.measure),
                       "none: a listed lattice is calibrated on its periodic sample, and has no "
                       "other test yet"}});
  if (a.curve) return calibrate_curve(a, host, geometry);

  const Calibration found = calibrate(a.choice, geometry);
  Json json = {{"lattice", a.lattice.lattice}, {"parameters", a.choice.parameters}};
  json.update(calibration_json(found));
  std::string text = calibration_text(found);
  if (a.measure) {
    const VirtualTest::Options options = a.virtual_test();
    const VirtualTestResult measured =
        VirtualTest(host, bundled::virtual_test, options)
            .measure(found.chosen.ratios, found.chosen.volumetric != 0
                                              ? std::optional(found.infinite.poisson)
                                              : std::nullopt);
    json["measured"] = measured_json(measured, options);
    text += measured_text(measured, options, found.infinite);
  }
  std::cout << (a.json ? json_text(json) : text) << std::flush;
  return exit_done;
}

}  // namespace

Command calibrate_command(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "calibrate", "from Young's modulus and the Poisson ratio to springs, and back; figure 2");
  a->lattice.declare(*command);
  command->add_option("--young", a->choice.young, "Young's modulus in Pa; gives k / l");
  command->add_option("--spacing", a->choice.spacing,
                      "lattice constant l in m; gives k, with --young");
  command->add_option(
      "--parameters", a->choice.parameters,
      "closed_form: exact for the infinite lattice (default); paper: polynomials (11) and (13)");
  command
      ->add_option("--measure", a->measure,
                   "also measure it by a compression test of N x N x N particles")
      ->type_name("N");
  command->add_option("--strain", a->strain, "of that test (default: 1e-3); negative pulls");
  command
      ->add_option("--curve", a->curve,
                   "many lambda in place of one, and the polynomials that fit them: figure 2 is "
                   "--curve 0 4.5 10 --measure 20")
      ->type_name("FROM TO POINTS");
  command->add_option("--each", a->each,
                      "a curve for each value of an option of the lattice: figure 3 is --each "
                      "coordination=8.4,13.2");
  command->add_option("--plot", a->plot,
                      "draw the curve (figures 2 and 3) to this SVG file; needs gnuplot");
  a->threads.declare(*command);
  command->add_flag("--json", a->json, "print it for machines");
  return {command, [a] { return calibrate(*a); }};
}

}  // namespace hyperlattice
