// The options of anything that declares them with Schema<Options>, as plain functions: of a
// plugin's component, of a shape, or of the core.
#pragma once

#include <hyperlattice/component.hpp>

namespace hyperlattice {

struct OptionSet {
  std::span<const Option> options;
  void* (*create)(const Complaint& why) noexcept = nullptr;
  void (*destroy)(void* options) noexcept = nullptr;
  bool (*check)(const void* options, const FaultSink& faults,
                const Complaint& why) noexcept = nullptr;  ///< null: nothing to check
  std::string_view name;  ///< of the plugin's component; none: code of the host
  const char* library = "";
};

/// `library`: the file of the component's plugin, outlives the set.
inline OptionSet option_set(const ComponentInfo& info, const char* library) {
  return {info.options,       info.create_options, info.destroy_options,
          info.check_options, info.name,           library};
}

/// Of a class that has `struct Options` and `static Schema<Options> schema()`.
template <class Declared>
OptionSet option_set() {
  using Options = typename Declared::Options;
  static const Schema<Options> schema = Declared::schema();
  OptionSet set{schema.options(),
                &detail::make_options<Options>,
                [](void* options) noexcept { delete static_cast<Options*>(options); },
                nullptr,
                {},
                ""};
  if (schema.cross_check() != nullptr)
    set.check = [](const void* options, const FaultSink& faults, const Complaint& why) noexcept {
      return detail::guarded(
          why, [&] { schema.cross_check()(*static_cast<const Options*>(options), faults); });
    };
  return set;
}

}  // namespace hyperlattice
