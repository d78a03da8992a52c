// The checks of each family, a file each. What they share: the component with its example, the
// scenes around it, and where findings go.
#pragma once

#include <contract/scenes.hpp>

#include <nlohmann/json.hpp>

#include <exception>
#include <utility>

namespace hyperlattice::contract {

/// What a check says.
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

/// A component under test.
class Trial {
 public:
  Trial(const Component& component, const Scenes& scenes, const std::filesystem::path& pictures,
        std::vector<Check>& checks)
      : component(component), scenes(scenes), pictures(pictures), checks_(checks) {}

  const Component& component;
  const Scenes& scenes;
  const std::filesystem::path& pictures;
  Json example;  ///< the component's stage, or a material's failure

  /// Runs one check; what it throws is a failure.
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

void check_lattice(Trial& trial);
void check_material(Trial& trial);
void check_failure(Trial& trial);
void check_load(Trial& trial);
void check_solver(Trial& trial);
void check_writer(Trial& trial);
void check_probe(Trial& trial);

}  // namespace hyperlattice::contract
