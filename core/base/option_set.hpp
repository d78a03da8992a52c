// The options of anything that declares them with Schema<Options> (a plugin's component, a shape,
// or the core), as a table of plain functions.
#pragma once

#include <hyperlattice/component.hpp>

namespace hyperlattice {

/// Declarations of options, and functions on an object that holds their values.
struct OptionSet {
  std::span<const Option> options;
  std::span<const OldName> old_names;
  void* (*create)(const Complaint& why) noexcept = nullptr;
  void (*destroy)(void* options) noexcept = nullptr;
  /// null: no cross-check
  bool (*check)(const void* options, const FaultSink& faults,
                const Complaint& why) noexcept = nullptr;
  std::string_view name;  ///< name of the plugin's component; empty: code of the host
  const char* library = "";
};

/// Returns the options of a plugin's component. `library`: the plugin's file; the text must outlive
/// the set.
inline OptionSet option_set(const ComponentInfo& info, const char* library) {
  return {
      info.options, info.old_names, info.create_options, info.destroy_options, info.check_options,
      info.name,    library};
}

/// Returns the options of a class with `struct Options` and `static Schema<Options> schema()`.
template <class Declared>
OptionSet option_set() {
  using Options = typename Declared::Options;
  static const Schema<Options> schema = Declared::schema();
  OptionSet set{schema.options(),
                schema.old_names(),
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
