#include <scene/common_options.hpp>

#include <algorithm>
#include <array>

namespace hyperlattice {

namespace {

using Declaration = Schema<CommonOptions>;

/// Returns whether a label is valid as part of a file name.
bool is_label(const std::string& name) {
  return !name.empty() && name.size() <= 80 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_' || c == '-' || c == '.';
         });
}

template <Family family>
struct CommonSchema {
  using Options = CommonOptions;
  static Declaration schema() {
    Declaration declared("", "");
    if (family == Family::failures || family == Family::engines) return declared;
    declared
        .add<&Options::name>("name", "",
                             "label of the stage, for messages and names of files; the last part "
                             "of its type if left out")
        .check([](const Options& options, const FaultSink& faults) {
          if (options.name && !is_label(*options.name))
            faults.fault(
                "name",
                "a label of letters, digits, \"_\", \"-\" and \".\", not beginning with a dot");
        });
    if (family == Family::materials)
      declared
          .add<&Options::region>("region", "",
                                 "where the material is; of several, the last one counts")
          .fallback("\"all\"");
    if (family == Family::solvers)
      declared
          .add<&Options::record_every>("record_every", "s",
                                       "time between records of the history; 200 records over the "
                                       "stage if left out, but no more than one in ten steps")
          .positive()
          .add<&Options::energy_tolerance>(
              "energy_tolerance", "",
              "relative error of the energy balance at which the run stops; 0: never")
          .at_least(0)
          .fallback("0.05")
          .add<&Options::approach_limit>(
              "approach_limit", "",
              "largest part of their distance by which the ends of a spring may come nearer in one "
              "step; beyond it the run stops before they pass through each other; 0: never")
          .at_least(0)
          .fallback("0.5")
          .add<&Options::growth_limit>(
              "growth_limit", "",
              "kinetic or stored energy over all that the start and the loads have put in, beyond "
              "which the run stops if the energy grows from record to record; linear motions in "
              "steps of r critical ones may reach 1 / (1 - r^2), by which the limit is multiplied; "
              "0: never")
          .at_least(0)
          .fallback("2")
          .add<&Options::momentum_tolerance>(
              "momentum_tolerance", "",
              "error of the momentum over the gross momentum at which the run stops; watched in "
              "double precision where nothing but given forces acts: no prescribed motion, no load "
              "that answers, no damping and no added mass; 0: never")
          .at_least(0)
          .fallback("1e-3")
          .add<&Options::mass_scaling>(
              "mass_scaling", "s",
              "of solvers that take explicit steps: critical time step that the stage gets; "
              "particles whose own is shorter get mass; none if left out")
          .positive();
    if (family == Family::writers || family == Family::probes)
      declared
          .add<&Options::every>("every", "s",
                                family == Family::writers
                                    ? "time between frames; 20 over the run if left out; 0: only "
                                      "the first and the last"
                                    : "time between samples; 200 over the run if left out; 0: only "
                                      "the first and the last. A sample is "
                                      "of the step nearest to its time, which the table gives: "
                                      "times are even to within a step")
          .at_least(0)
          .add<&Options::first>("first", "", "whether the state before the first step is written")
          .fallback("true")
          .add<&Options::last>("last", "", "whether the state after the last step is written")
          .fallback("true");
    return declared;
  }
};

}  // namespace

const OptionSet& common_options(Family family) {
  static const std::array sets{
      option_set<CommonSchema<Family::lattices>>(), option_set<CommonSchema<Family::materials>>(),
      option_set<CommonSchema<Family::failures>>(), option_set<CommonSchema<Family::loads>>(),
      option_set<CommonSchema<Family::solvers>>(),  option_set<CommonSchema<Family::writers>>(),
      option_set<CommonSchema<Family::probes>>(),   option_set<CommonSchema<Family::engines>>()};
  return sets[static_cast<std::size_t>(family)];
}

std::optional<Family> family_of(std::string_view type) {
  const auto* const found =
      std::find(std::begin(family_names), std::end(family_names), type.substr(0, type.find('.')));
  if (found == std::end(family_names)) return std::nullopt;
  return static_cast<Family>(found - std::begin(family_names));
}

}  // namespace hyperlattice
