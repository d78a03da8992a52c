#include <model/build.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

InputError objection(const Scene& scene, const Stage& stage, const std::string& sentence) {
  const std::string first = sentence.substr(0, sentence.find(' '));
  const auto& options = stage.component->info.options;
  const bool names_option = std::any_of(options.begin(), options.end(),
                                        [&](const Option& option) { return option.name == first; });
  if (!names_option) return refusal(stage, sentence);
  const auto resolved =
      nlohmann::json::parse(scene.resolved).at(nlohmann::json::json_pointer(stage.pointer));
  return InputError({{stage.pointer + "/" + first,
                      resolved.contains(first) ? resolved[first].dump() : "", sentence}});
}

}  // namespace hyperlattice
