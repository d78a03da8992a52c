// The state from which a run starts, if it does not start from the undeformed body at rest.
#pragma once

#include <base/errors.hpp>
#include <plan/body_facts.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace hyperlattice {

/// The final state of another run, which that run kept in a file.
struct StartState {
  std::filesystem::path file;
  std::string hash;  ///< of the file
  double time = 0;   ///< s, at which the run starts
  std::uint64_t steps = 0;
  std::int32_t blocks = 1;  ///< in which the body is stored
  BodyFacts body;
};

/// Adds a fault for each difference between the body of the state and that of the model.
void check_start(const StartState& start, const Model& model, Faults& faults);

}  // namespace hyperlattice
