// Calls of functions of a stage's component, with errors that name the stage.
#pragma once

#include <host/plugin_call.hpp>
#include <scene/scene.hpp>

#include <optional>

namespace hyperlattice {

/// Returns an error that names the component, its place in the scene, its library and the function.
inline OutsideError plugin_error(const Stage& stage, const std::string& function,
                                 const std::string& sentence) {
  return plugin_failure(stage.component->info.name, stage.pointer, stage.component->path.native(),
                        function, sentence);
}

/// Calls a function that may refuse. `code` gets the Complaint and returns true after success.
/// Returns the sentence of a refusal. Throws OutsideError if the component got no memory or called
/// the host wrongly. It is only a wrapper, and has no frame of its own between a step and the law.
template <class Code>
[[gnu::always_inline]] inline std::optional<std::string> refusal_of(const Stage& stage,
                                                                    const char* function,
                                                                    Code&& code) {
  PluginCall call(stage.component->info.name, stage.component->path.c_str(), function,
                  stage.pointer);
  try {
    const std::string* sentence = call.failure(code(call.why()));
    return sentence == nullptr ? std::nullopt : std::optional(*sentence);
  } catch (const PluginMistake& mistake) {
    throw plugin_error(stage, function, mistake.what());
  }
}

/// Calls a function that must not fail, also without a frame. Throws OutsideError if it fails.
template <class Code>
[[gnu::always_inline]] inline void call(const Stage& stage, const char* function, Code&& code) {
  if (const auto sentence = refusal_of(stage, function, code))
    throw plugin_error(stage, function, *sentence);
}

}  // namespace hyperlattice
