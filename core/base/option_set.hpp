// The options of anything that declares them with Schema<Options>, as plain functions: of a plugin's component, of a shape, or of the core.
#pragma once

#include <hyperlattice/component.hpp>

namespace hyperlattice {

struct OptionSet {
  std::span<const Option> options;
  void* (*create)() noexcept = nullptr;
  void (*destroy)(void* options) noexcept = nullptr;
  void (*check)(const void* options, const FaultSink& faults) noexcept = nullptr;  ///< null: nothing to check
};

inline OptionSet option_set(const ComponentInfo& info) { return {info.options, info.create_options, info.destroy_options, info.check_options}; }

/// Of a class that has `struct Options` and `static Schema<Options> schema()`.
template <class Declared>
OptionSet option_set() {
  using Options = typename Declared::Options;
  static const Schema<Options> schema = Declared::schema();
  OptionSet set{schema.options(), []() noexcept -> void* { return new Options(); },
                [](void* options) noexcept { delete static_cast<Options*>(options); }, nullptr};
  if (schema.cross_check() != nullptr)
    set.check = [](const void* options, const FaultSink& faults) noexcept { schema.cross_check()(*static_cast<const Options*>(options), faults); };
  return set;
}

}  // namespace hyperlattice
