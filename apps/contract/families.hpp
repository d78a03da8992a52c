// The checks of the families; each family has its own file. This header has what all of them use:
// the component with its example, the scenes, and the list of results.
#pragma once

#include <contract/scenes.hpp>

#include <nlohmann/json.hpp>

#include <exception>
#include <utility>

namespace hyperlattice::contract {

/// The result of a check, before it gets its name.
struct Finding {
  Verdict verdict = Verdict::passed;
  std::string detail;
};
inline Finding passes_if(bool holds, std::string detail) {
  return {holds ? Verdict::passed : Verdict::failed, std::move(detail)};
}
inline Finding not_applicable(std::string reason) {
  return {Verdict::not_applicable, std::move(reason)};
}

/// The component under test, with what its checks need.
class Trial {
 public:
  Trial(const Component& component, const Scenes& scenes, const std::filesystem::path& pictures,
        std::vector<Check>& checks)
      : component(component), scenes(scenes), pictures(pictures), checks_(checks) {}

  const Component& component;
  const Scenes& scenes;
  const std::filesystem::path& pictures;
  Json example;  ///< the component's stage; for a failure criterion, the value of the material's
                 ///< key "failure"

  /// Runs one check and stores its result; an exception is a failed check.
  template <class Code>
  void check(const char* name, Code&& code) {
    Finding finding;
    try {
      finding = code();
    } catch (const std::exception& error) {
      finding = {Verdict::failed, error.what()};
    }
    checks_.push_back({name, finding.verdict, std::move(finding.detail)});
  }

 private:
  std::vector<Check>& checks_;
};

/// Compares the bits of a motion, in which failure takes energy, on 1 and 3 threads.
Finding same_bits_while_failing(const Model& model, RandomMotion motion);
/// Compares the bits of a whole motion with those of one that a checkpoint interrupts.
Finding restart_while_failing(const Model& model, RandomMotion motion);

void check_lattice(Trial& trial);
void check_material(Trial& trial);
void check_failure(Trial& trial);
void check_surface(Trial& trial);
void check_load(Trial& trial);
void check_solver(Trial& trial);
void check_writer(Trial& trial);
void check_probe(Trial& trial);
void check_engine(Trial& trial);

}  // namespace hyperlattice::contract
