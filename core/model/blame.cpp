#include <base/errors.hpp>
#include <model/blame.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

namespace hyperlattice {

namespace {

/// Returns the scene's text of a load, cut to at most 300 characters.
std::string text_of(const Model& model, const Stage& stage) {
  std::string text;
  const nlohmann::json resolved = nlohmann::json::parse(model.scene->resolved, nullptr, false);
  if (const nlohmann::json::json_pointer at(stage.pointer);
      !resolved.is_discarded() && resolved.contains(at))
    text = resolved.at(at).dump();
  constexpr std::size_t most = 300;
  return text.size() > most ? text.substr(0, most) + "..." : text;
}

}  // namespace

void blame_load(const Model& model, std::size_t load, const std::string& what) {
  const Stage& stage = *model.loads[load].stage;
  throw RunError(fmt::format("{} ({}): {}. The load is {}", stage.component->type(), stage.pointer,
                             what, text_of(model, stage)));
}

}  // namespace hyperlattice
