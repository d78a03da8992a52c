#include <scene/expectation.hpp>
#include <scene/stage_names.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace hyperlattice {

namespace {

struct Candidate {
  std::string pointer, name, type;
};

/// Returns the stages and criteria of a scene that have a type.
std::vector<Candidate> candidates_in(const Json& scene) {
  std::vector<Candidate> found;
  const auto add = [&](const Json& stage, const std::string& pointer) {
    if (stage.is_object())
      found.push_back({pointer, word_in(stage, "name"), word_in(stage, "type")});
  };
  const auto pipeline = scene.find("pipeline");
  if (pipeline == scene.end() || !pipeline->is_array()) return found;
  for (std::size_t n = 0; n < pipeline->size(); ++n) {
    const Json& stage = (*pipeline)[n];
    const std::string pointer = member("/pipeline", n);
    add(stage, pointer);
    const auto failure = stage.find("failure");
    if (failure == stage.end()) continue;
    const std::string at = member(pointer, "failure");
    if (!failure->is_array()) add(*failure, at);
    for (std::size_t k = 0; failure->is_array() && k < failure->size(); ++k)
      add((*failure)[k], member(at, k));
  }
  return found;
}

/// Returns the names by which one stage can be meant, each once.
std::vector<std::string> usable_names(const std::vector<Candidate>& all) {
  std::vector<std::string> names;
  for (const Candidate& one : all) {
    const auto count = [&](auto part, const std::string& text) {
      return std::count_if(all.begin(), all.end(),
                           [&](const Candidate& other) { return other.*part == text; });
    };
    if (!one.name.empty() && count(&Candidate::name, one.name) == 1)
      names.push_back(one.name);
    else if (!one.type.empty() && count(&Candidate::type, one.type) == 1)
      names.push_back(one.type);
  }
  return names;
}

}  // namespace

NamedStage find_stage(const Json& scene, const std::string& name) {
  const std::vector<Candidate> all = candidates_in(scene);
  for (const auto part : {&Candidate::name, &Candidate::type}) {
    std::vector<Candidate> found;
    std::copy_if(all.begin(), all.end(), std::back_inserter(found),
                 [&](const Candidate& one) { return one.*part == name; });
    if (found.size() == 1) return {found.front().pointer, ""};
    if (found.empty()) continue;
    std::string several;
    for (const Candidate& one : found)
      several += fmt::format("{}{}{}", several.empty() ? "" : ", ", one.pointer,
                             one.name.empty() ? fmt::format(" ({})", one.type)
                                              : fmt::format(" ({}, {})", one.name, one.type));
    return {"", fmt::format("the name or type of one stage; \"{}\" may be {}", name, several)};
  }
  const std::vector<std::string> names = usable_names(all);
  std::vector<std::string> known = names;
  for (const Candidate& one : all) known.push_back(one.type);
  const std::string near = did_you_mean(name, known);
  return {"", fmt::format("the name or type of a stage{}",
                          near.empty() && !names.empty()
                              ? fmt::format("; there are {}", fmt::join(names, ", "))
                              : near)};
}

}  // namespace hyperlattice
