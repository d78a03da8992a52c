// hyperlattice analyze: elasticity, stability over the Brillouin zone, critical time step and
// dispersion of a lattice; the map of cubic crystals.
#include "commands.hpp"

#include <analyze/analysis.hpp>
#include <analyze/crystal_report.hpp>
#include <analyze/dispersion.hpp>
#include <analyze/load_lattice.hpp>
#include <base/gnuplot.hpp>
#include <base/named_file.hpp>
#include <run/output_file.hpp>

#include <nlohmann/json.hpp>

#include <iostream>

namespace hyperlattice {
namespace {

struct Arguments : LatticeArguments {
  std::string dispersion, crystals, plot;
  bool json = false;
};

/// Throws InputError if the arguments contradict each other.
void check(const Arguments& arguments) {
  Faults faults;
  const MembraneChoice& m = arguments.membrane;
  const bool needs =
      m.poisson || m.lambda || m.k_alpha || m.k_beta || m.k_gamma || !arguments.dispersion.empty();
  if (m.membrane.empty() && (needs || (arguments.crystals.empty() && arguments.plot.empty())))
    faults.add("--membrane", "", "a membrane: none, I, II, III, IV, I-m or free");
  if (arguments.lattice != bundled::cubic &&
      !(arguments.crystals.empty() && arguments.plot.empty()))
    faults.add("--lattice", arguments.lattice,
               std::string(bundled::cubic) + ", the one whose crystals are known");
  std::vector<std::filesystem::path> inputs = arguments.files();
  inputs.emplace_back(arguments.crystals);
  if (!arguments.dispersion.empty())
    check_output_file({"--dispersion", arguments.dispersion, {".csv"}}, inputs, faults);
  if (!arguments.plot.empty())
    check_output_file({"--plot", arguments.plot, {".svg"}}, inputs, faults);
  faults.throw_if_any();
}

int analyze(const Arguments& arguments) {
  check(arguments);
  const auto crystals = arguments.crystals.empty() ? std::vector<FittedCrystal>{}
                                                   : fit_all(read_crystals(arguments.crystals));
  Json json = {{"lattice", arguments.lattice}};
  std::string text;
  std::optional<MapPoint> point;
  if (!arguments.membrane.membrane.empty()) {
    Host host;
    const LatticeGeometry geometry = load_lattice(host, arguments.lattice, arguments.options);
    const ChosenMembrane chosen = resolve(arguments.membrane, geometry);
    const SpringLattice lattice = lattice_of(chosen, geometry);
    if (geometry.listed && !arguments.dispersion.empty())
      throw InputError({{"--dispersion", arguments.dispersion,
                         "none: waves of a listed lattice have no wave vector"}});
    const Analysis analysis = analyse(lattice);
    point = MapPoint{analysis.elasticity.poisson_bulk(), analysis.elasticity.poisson_shear()};
    json.update(chosen_json(chosen));
    json.update(analysis_json(analysis));
    text = analysis_text(analysis);
    if (!arguments.dispersion.empty())
      write_named_file(arguments.dispersion,
                       dispersion_csv(lattice.endless(), lattice.base_stiffness()));
  }
  if (!crystals.empty()) {
    json.update(crystals_json(crystals));
    text += (text.empty() ? "" : "\n") + crystals_text(crystals);
  }
  if (!arguments.plot.empty())
    write_named_file(arguments.plot,
                     svg_picture(arguments.plot, crystal_map_script(crystals, point)));
  std::cout << (arguments.json ? json_text(json) : text) << std::flush;
  return exit_done;
}

}  // namespace

Command analyze_command(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "analyze", "elasticity, stability and time step of a lattice; the map of cubic crystals");
  a->declare(*command);
  command
      ->add_option(
          "--dispersion", a->dispersion,
          "write omega / sqrt(k/m) of the waves along [100], [110] and [111] to this CSV file")
      ->type_name("FILE");
  command
      ->add_option(
          "--crystals", a->crystals,
          "read cubic crystals from this CSV file and find lattices with their elastic constants")
      ->type_name("FILE");
  command
      ->add_option("--plot", a->plot,
                   "draw the map of Poisson ratios (figure 4) to this SVG file; needs gnuplot")
      ->type_name("FILE");
  command->add_flag("--json", a->json, "print it for machines");
  return {command, [a] { return analyze(*a); }};
}

}  // namespace hyperlattice
