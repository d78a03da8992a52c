// hyperlattice calibrate: stiffnesses from E and nu and back, in closed form, by the paper's
// polynomials, or measured on a cube; figure 2.
#include "commands.hpp"

#include <analyze/calibration_task.hpp>
#include <base/gnuplot.hpp>
#include <base/named_file.hpp>
#include <run/output_file.hpp>

#include <nlohmann/json.hpp>

#include <iostream>

namespace hyperlattice {
namespace {

struct Arguments {
  LatticeArguments lattice;
  CalibrationTask task;
  std::string plot;
  ThreadArgument threads;
  bool json = false;
};

/// Throws InputError if the arguments contradict each other.
void check(const Arguments& a) {
  Faults faults;
  check(a.task, faults);
  if (!a.plot.empty() && !a.task.curve)
    faults.add("--plot", a.plot, "--curve with it: that is what is drawn");
  if (!a.plot.empty()) check_output_file({"--plot", a.plot, {".svg"}}, a.lattice.files(), faults);
  faults.throw_if_any();
}

int calibrate(Arguments a) {
  check(a);
  a.task.lattice = a.lattice.lattice;
  a.task.options = a.lattice.options;
  a.task.choice.membrane = a.lattice.membrane;
  a.task.threads = a.threads.threads;
  Host host;
  const CalibrationAnswer answer = perform(a.task, host, bundled::virtual_test);
  if (!a.plot.empty())
    write_named_file(a.plot, svg_picture(a.plot, answer.script, answer.width, answer.height));
  std::cout << (a.json ? json_text(answer.json) : answer.text) << std::flush;
  return exit_done;
}

}  // namespace

Command calibrate_command(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "calibrate", "from Young's modulus and the Poisson ratio to springs, and back; figure 2");
  a->lattice.declare(*command);
  command->add_option("--young", a->task.choice.young, "Young's modulus in Pa; gives k / l");
  command->add_option("--spacing", a->task.choice.spacing,
                      "lattice constant l in m; gives k, with --young");
  command
      ->add_option(
          "--parameters", a->task.choice.parameters,
          "closed_form: exact for the infinite lattice (default); paper: polynomials (11) and (13)")
      ->type_name("closed_form|paper");
  command
      ->add_option("--measure", a->task.measure,
                   "also measure it by a compression test of N x N x N particles")
      ->type_name("N");
  command->add_option("--strain", a->task.strain, "of that test (default: 1e-3); negative pulls");
  command
      ->add_option("--curve", a->task.curve,
                   "many lambda in place of one, and the polynomials that fit them: figure 2 is "
                   "--curve 0 4.5 10 --measure 20")
      ->type_name("FROM TO POINTS");
  command->add_option("--each", a->task.each,
                      "a curve for each value of an option of the lattice: figure 3 is --each "
                      "coordination=8.4,13.2");
  command
      ->add_option("--plot", a->plot,
                   "draw the curve (figures 2 and 3) to this SVG file; needs gnuplot")
      ->type_name("FILE");
  a->threads.declare(*command);
  command->add_flag("--json", a->json, "print it for machines");
  return {command, [a] { return calibrate(*a); }};
}

}  // namespace hyperlattice
