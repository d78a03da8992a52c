// What every plugin exports, and the gate that it must pass before any of its code runs.
//
//   class Blast { public: struct Options {...}; static Schema<Options> schema(); explicit Blast(const Options&); ... };
//   HYPERLATTICE_PLUGIN("1.0") { plugin.add<Blast>(); }
#pragma once

#include <hyperlattice/options.hpp>

#include <exception>

#define HYPERLATTICE_EXPORT __attribute__((visibility("default")))

/// Raised whenever the layout or meaning of anything in these headers changes.
#ifndef HYPERLATTICE_INTERFACE_VERSION
#define HYPERLATTICE_INTERFACE_VERSION 1
#endif

namespace hyperlattice {

enum class Family : std::uint32_t { lattices, materials, failures, loads, solvers, writers, probes };
inline constexpr std::string_view family_names[] = {"lattices", "materials", "failures", "loads", "solvers", "writers", "probes"};

/// A component as the core sees it: its declaration, and tables of functions.
struct ComponentInfo {
  Family family{};
  std::string_view name;  ///< "<family>.<name>", the value of "type" in a scene
  std::string_view summary, equation, source, restrictions;
  std::span<const Option> options;
  void* (*create_options)() noexcept = nullptr;
  void (*destroy_options)(void* options) noexcept = nullptr;
  void (*check_options)(const void* options, const FaultSink& faults) noexcept = nullptr;  ///< null: nothing to check
  void* (*create)(const void* options, const Complaint& why) noexcept = nullptr;           ///< null result: refused, with a sentence
  void (*destroy)(void* component) noexcept = nullptr;
  const void* functions = nullptr;  ///< the family's table: LatticeFunctions, MaterialFunctions, ...
  std::uint64_t functions_size = 0;
};

/// Given to a plugin's registration. What it adds counts only when the whole registration returns.
class Registrar {
 public:
  Registrar(void* self, void (*receive)(void* self, const ComponentInfo& info)) : self_(self), receive_(receive) {}

  /// Registers a component class of any family (see lattice.hpp, material.hpp, failure.hpp, load.hpp, solver.hpp, output.hpp).
  template <class Component>
  void add();

 private:
  void* self_;
  void (*receive_)(void* self, const ComponentInfo& info);
};

/// What a plugin's library exports under the name `hyperlattice_plugin`.
struct PluginInfo {
  std::string_view version;
  bool (*register_components)(Registrar& plugin, const Complaint& why) noexcept;
};

namespace detail {

/// Runs code of a plugin; an exception becomes a sentence, so that none crosses the boundary.
template <class Code>
bool guarded(const Complaint& why, Code&& code) noexcept {
  try {
    code();
    return true;
  } catch (const std::exception& error) {
    why.say(error.what());
  } catch (...) {
    why.say("an exception of unknown type");
  }
  return false;
}

/// The family's table of functions for a component class; each family's header specialises it.
template <class Component>
struct FunctionsOf;

template <class Component>
ComponentInfo describe() {
  using Options = typename Component::Options;
  static const Schema<Options> schema = Component::schema();
  ComponentInfo info;
  info.family = FunctionsOf<Component>::family;
  info.name = schema.name();
  info.summary = schema.summary();
  info.equation = schema.equation();
  info.source = schema.source();
  info.restrictions = schema.restrictions();
  info.options = schema.options();
  info.create_options = []() noexcept -> void* { return new Options(); };
  info.destroy_options = [](void* options) noexcept { delete static_cast<Options*>(options); };
  if (schema.cross_check() != nullptr)
    info.check_options = [](const void* options, const FaultSink& faults) noexcept {
      schema.cross_check()(*static_cast<const Options*>(options), faults);
    };
  info.create = [](const void* options, const Complaint& why) noexcept -> void* {
    Component* made = nullptr;
    guarded(why, [&] { made = new Component(*static_cast<const Options*>(options)); });
    return made;
  };
  info.destroy = [](void* component) noexcept { delete static_cast<Component*>(component); };
  info.functions = &FunctionsOf<Component>::table;
  info.functions_size = sizeof(FunctionsOf<Component>::table);
  return info;
}

// What decides whether two libraries can share objects. Eigen aligns by the widest vector unit it was compiled for.
inline constexpr unsigned compiler_abi = __GXX_ABI_VERSION / 1000;  // the C++ ABI in force, not its minor revision
#if defined(_GLIBCXX_USE_CXX11_ABI)
inline constexpr unsigned library_abi = _GLIBCXX_USE_CXX11_ABI;
#else
inline constexpr unsigned library_abi = 2;
#endif
#if defined(__AVX512F__)
inline constexpr unsigned eigen_alignment = 64;
#elif defined(__AVX__)
inline constexpr unsigned eigen_alignment = 32;
#else
inline constexpr unsigned eigen_alignment = 16;
#endif

}  // namespace detail

/// A symbol whose mangled name carries the gate's numbers, so that the core reads them from the file without loading it.
template <unsigned Interface, unsigned CompilerAbi, unsigned LibraryAbi, unsigned EigenAlignment, unsigned ComponentSize, unsigned OptionSize,
          unsigned ValueSize>
struct HYPERLATTICE_EXPORT Gate {
  static const char marker;
};
template <unsigned A, unsigned B, unsigned C, unsigned D, unsigned E, unsigned F, unsigned G>
const char Gate<A, B, C, D, E, F, G>::marker = 1;

using ThisGate = Gate<HYPERLATTICE_INTERFACE_VERSION, detail::compiler_abi, detail::library_abi, detail::eigen_alignment, sizeof(ComponentInfo),
                      sizeof(Option), sizeof(OptionValue)>;

template <class Component>
void Registrar::add() {
  receive_(self_, detail::describe<Component>());
}

}  // namespace hyperlattice

/// Begins the one registration function of a plugin; its body names the components.
#define HYPERLATTICE_PLUGIN(version_text)                                                                      \
  static void hyperlattice_register_body(::hyperlattice::Registrar& plugin);                                   \
  extern "C" HYPERLATTICE_EXPORT const char* hyperlattice_gate() { return &::hyperlattice::ThisGate::marker; } \
  extern "C" HYPERLATTICE_EXPORT const ::hyperlattice::PluginInfo hyperlattice_plugin{                         \
      version_text, [](::hyperlattice::Registrar& plugin, const ::hyperlattice::Complaint& why) noexcept {     \
        return ::hyperlattice::detail::guarded(why, [&] { hyperlattice_register_body(plugin); });              \
      }};                                                                                                      \
  static void hyperlattice_register_body(::hyperlattice::Registrar& plugin)
