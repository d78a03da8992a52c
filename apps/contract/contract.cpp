#include <contract/families.hpp>
#include <scene/examples.hpp>

namespace hyperlattice::contract {
namespace {

/// Returns the option that names an input file, which an example cannot have; empty if there is
/// none.
std::string missing_file(const ComponentInfo& info, const Json& example) {
  for (const Option& option : info.options)
    if (std::string name(option.name); option.kind == OptionKind::file && example.contains(name))
      return name;
  return "";
}

void check_family(Trial& trial) {
  switch (trial.component.info.family) {
    case Family::lattices:
      return check_lattice(trial);
    case Family::materials:
      return check_material(trial);
    case Family::failures:
      return check_failure(trial);
    case Family::loads:
      return check_load(trial);
    case Family::solvers:
      return check_solver(trial);
    case Family::writers:
      return check_writer(trial);
    case Family::probes:
      return check_probe(trial);
    case Family::engines:
      return check_engine(trial);
  }
}

}  // namespace

std::vector<Check> check(const Component& component, Host& host, const OtherComponents& around,
                         const std::filesystem::path& pictures) {
  std::vector<Check> checks;
  const Scenes scenes(host, around);
  Trial trial(component, scenes, pictures, checks);
  trial.example = example_stage(component.info);
  if (const std::string option = missing_file(component.info, trial.example); !option.empty())
    trial.check("example", [&] {
      return not_applicable("it needs a file, option " + option +
                            ": test it in a scene of its own");
    });
  else
    try {
      check_family(trial);
    } catch (const std::exception& error) {  // affects all checks of the family
      trial.check("example", [&] {
        return Finding{Verdict::failed, trial.example.dump() + ": " + error.what()};
      });
    }
  return checks;
}

}  // namespace hyperlattice::contract
