#include <base/figures.hpp>
#include <report/facts.hpp>

#include <hyperlattice/files.hpp>

#include <cmath>

namespace hyperlattice::report {

namespace {

enum class Kind { word, count, number, bytes, nanoseconds, percent, unit, step };

struct Shown {
  const char* name;
  const char* pointer;
  Kind kind;
  const char* unit = "";
};

constexpr Shown shown_figures[] = {
    {"Status", "/status", Kind::word},
    {"Particles", "/particles", Kind::count},
    {"Volume of the body", "/body/volume", Kind::unit, "m3"},
    {"Mass of the body", "/body/mass", Kind::unit, "kg"},
    {"Bodies that no spring joins", "/body/parts", Kind::count},
    {"Springs of the base layer", "/springs", Kind::count},
    {"Springs per particle", "/springs_per_particle", Kind::number},
    {"Degrees of freedom per particle", "/degrees_of_freedom", Kind::count},
    {"Membrane", "/membrane", Kind::word},
    {"Precision", "/precision", Kind::word},
    {"Instructions", "/instructions", Kind::word},
    {"Threads", "/threads", Kind::count},
    {"Steps", "/steps", Kind::count},
    {"End time", "/end_time", Kind::unit, "s"},
    {"Time step", "/time_step", Kind::step, "s"},
    {"Critical time step", "/critical_time_step", Kind::unit, "s"},
    {"Run time: set-up", "/wall_seconds/setup", Kind::unit, "s"},
    {"Run time: solve", "/wall_seconds/solve", Kind::unit, "s"},
    {"Run time: output", "/wall_seconds/output", Kind::unit, "s"},
    {"Time per particle and step", "/nanoseconds_per_particle_step", Kind::nanoseconds},
    {"State per particle", "/bytes_per_particle", Kind::number, " B"},
    {"Memory, planned", "/memory_bytes", Kind::bytes},
    {"Memory, at its peak", "/peak_memory_bytes", Kind::bytes},
    {"Kinetic energy at the end", "/energy/kinetic", Kind::unit, "J"},
    {"Stored energy at the end", "/energy/stored", Kind::unit, "J"},
    {"Dissipated energy", "/energy/dissipated", Kind::unit, "J"},
    {"Injected energy", "/energy/injected", Kind::unit, "J"},
    {"Balance error at the end", "/energy/relative_error", Kind::percent},
    {"Balance error at its largest", "/energy/largest_relative_error", Kind::percent},
    {"Residual at rest", "/rest/residual", Kind::number},
    {"Error of displacements at rest", "/rest/displacement_error", Kind::percent},
    {"Broken springs, open", "/broken_springs/open", Kind::count},
    {"Broken springs, closed", "/broken_springs/closed", Kind::count},
    {"Hash of the state", "/state_hash", Kind::word},
    {"Version", "/version", Kind::word},
};

std::string text_of(const RunRecord& run, const Shown& figure) {
  if (figure.kind == Kind::word) return run.word(figure.pointer);
  const auto number = run.number(figure.pointer);
  if (!number) return "";
  switch (figure.kind) {
    case Kind::count:
      return count_text_of(*number);
    case Kind::bytes:
      return bytes_text(*number);
    case Kind::nanoseconds:
      return quantity_text(1e-9 * *number, "s");
    case Kind::percent:
      return percent_text(std::abs(*number));
    case Kind::unit:
      return quantity_text(*number, figure.unit);
    case Kind::step:
      return *number > 0 ? quantity_text(*number, figure.unit)
                         : "";  // static solvers may have none
    default:
      return short_number(*number, 4) + figure.unit;
  }
}

}  // namespace

std::vector<Fact> facts(const RunRecord& run) {
  std::vector<Fact> found;
  for (const Shown& figure : shown_figures)
    found.push_back({figure.name, figure.pointer, text_of(run, figure)});
  if (run.summary.is_null()) found.front().text = run.status();
  return found;
}

Json figures(const RunRecord& run) {
  Json found = Json::object();
  for (const Shown& figure : shown_figures) {
    const Json::json_pointer place(figure.pointer);
    if (run.summary.is_object() && run.summary.contains(place))
      found[place] = run.summary.at(place);
  }
  return found;
}

}  // namespace hyperlattice::report
