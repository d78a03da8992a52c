// Facts by which a body is known: the state of one body is a state of another only if all of them
// are equal. Stiffness, strength and density are not among them.
#pragma once

#include <model/model.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace hyperlattice {

struct BodyFact {
  std::string name;
  std::string value;       ///< or a hash of it
  bool is_hashed = false;  ///< the value says nothing to a reader
};
using BodyFacts = std::vector<BodyFact>;

/// Returns the facts of a model's body. Reads every particle and every cut spring once.
BodyFacts body_facts(const Model& model);

/// Returns one clause for each fact in which the body of a state differs from that of a scene:
/// "particles: 2197 in the state, 4096 in the scene".
std::vector<std::string> differences(const BodyFacts& state, const BodyFacts& scene);

nlohmann::json body_facts_json(const BodyFacts& facts);
/// Returns the facts from their JSON. Throws nlohmann::json::exception if it is none.
BodyFacts read_body_facts(const nlohmann::json& json);

}  // namespace hyperlattice
