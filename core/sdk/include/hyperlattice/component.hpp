// A component as a plugin registers it. boundary.hpp has the gate that a plugin must pass before
// any of its code runs.
//
//   class Blast {
//    public:
//     struct Options {...};
//     static Schema<Options> schema();
//     explicit Blast(const Options&);
//     ...
//   };
//   HYPERLATTICE_PLUGIN("1.0") { plugin.add<Blast>(); }
#pragma once

#include <hyperlattice/missing_function.hpp>
#include <hyperlattice/options.hpp>

#define HYPERLATTICE_EXPORT __attribute__((visibility("default")))

namespace hyperlattice {

enum class Family : std::uint32_t {
  lattices,
  materials,
  failures,
  loads,
  solvers,
  writers,
  probes,
  engines
};
inline constexpr std::string_view family_names[] = {"lattices", "materials", "failures", "loads",
                                                    "solvers",  "writers",   "probes",   "engines"};

/// A component as the core sees it: its declaration, and tables of functions.
struct ComponentInfo {
  Family family{};
  std::string_view name;  ///< "<family>.<name>", the value of "type" in a scene
  std::string_view summary, equation, source, restrictions;
  std::span<const Option> options;
  std::span<const OldName> old_names;
  std::span<const FieldInfo> fields;  ///< that a material's law gives, besides those of field_table
  /// Null result: failed; `why` has the reason.
  void* (*create_options)(const Complaint& why) noexcept = nullptr;
  void (*destroy_options)(void* options) noexcept = nullptr;
  bool (*check_options)(const void* options, const FaultSink& faults,
                        const Complaint& why) noexcept = nullptr;  ///< null: nothing to check
  /// Null result: refused; `why` has the reason.
  void* (*create)(const void* options, const Complaint& why) noexcept = nullptr;
  void (*destroy)(void* component) noexcept = nullptr;
  /// The family's table of functions: LatticeFunctions, MaterialFunctions, ... (functions_size
  /// bytes).
  const void* functions = nullptr;
  std::uint64_t functions_size = 0;
};

/// Receives the components of a plugin. They count only if the whole registration returns.
class Registrar {
 public:
  Registrar(void* self, void (*receive)(void* self, const ComponentInfo& info) noexcept)
      : self_(self), receive_(receive) {}

  /// Registers a component class of any family (see lattice.hpp, material.hpp, failure.hpp,
  /// load.hpp, solver.hpp, output.hpp, engine.hpp).
  template <class Component>
  void add();

 private:
  void* self_;
  void (*receive_)(void* self, const ComponentInfo& info) noexcept;
};

/// The data that a plugin's library exports under the name `hyperlattice_plugin`.
struct PluginInfo {
  std::string_view version;
  bool (*register_components)(Registrar& plugin, const Complaint& why) noexcept;
};

namespace detail {

/// The family's table of functions for a component class; each family's header specialises it. A
/// class that no specialisation fits gets a message of the compiler, and members that keep it from
/// more messages.
template <class Component>
struct FunctionsOf : MissingFunction<Component> {
  static constexpr Family family{};
  static constexpr int table = 0;
};

/// What the host holds of a component class; a family's header may add data to it.
template <class Component>
struct Held {
  using type = Component;
};

template <class Options>
void* make_options(const Complaint& why) noexcept {
  Options* made = nullptr;
  guarded(why, [&] { made = new Options(); });
  return made;
}

template <class Component>
ComponentInfo describe() {
  using Options = typename Component::Options;
  using Made = typename Held<Component>::type;
  static const Schema<Options> schema = Component::schema();
  ComponentInfo info;
  info.family = FunctionsOf<Component>::family;
  info.name = schema.name();
  info.summary = schema.summary();
  info.equation = schema.equation();
  info.source = schema.source();
  info.restrictions = schema.restrictions();
  info.options = schema.options();
  info.old_names = schema.old_names();
  info.fields = schema.fields();
  info.create_options = &make_options<Options>;
  info.destroy_options = [](void* options) noexcept { delete static_cast<Options*>(options); };
  if (schema.cross_check() != nullptr)
    info.check_options = [](const void* options, const FaultSink& faults,
                            const Complaint& why) noexcept {
      return guarded(why,
                     [&] { schema.cross_check()(*static_cast<const Options*>(options), faults); });
    };
  info.create = [](const void* options, const Complaint& why) noexcept -> void* {
    Made* made = nullptr;
    guarded(why, [&] { made = new Made(*static_cast<const Options*>(options)); });
    return made;
  };
  info.destroy = [](void* component) noexcept { delete static_cast<Made*>(component); };
  info.functions = &FunctionsOf<Component>::table;
  info.functions_size = sizeof(FunctionsOf<Component>::table);
  return info;
}

}  // namespace detail

template <class Component>
void Registrar::add() {
  receive_(self_, detail::describe<Component>());
}

}  // namespace hyperlattice
