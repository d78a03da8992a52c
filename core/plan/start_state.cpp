#include <plan/start_state.hpp>

namespace hyperlattice {

void check_start(const StartState& start, const Model& model, Faults& faults) {
  for (const std::string& difference : differences(start.body, body_facts(model)))
    faults.add("--from", start.file.string(), "a state of the scene's body; " + difference);
}

}  // namespace hyperlattice
