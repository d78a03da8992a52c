// Plugins that are one source file: compiled with the headers and flags of this installation, and
// kept in the user's cache.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// The library of a source file, or why there is none.
struct CompiledPlugin {
  enum class Problem {
    none,
    source,  ///< the compiler refuses the source
    outside  ///< there is no compiler, no space, no time
  };
  std::filesystem::path library;
  Problem problem = Problem::none;
  std::string sentence;  ///< about the problem; several lines if it is the compiler's
};

/// Returns whether a file is the source of a plugin, by its name: .cpp, .cc or .cxx.
bool is_plugin_source(const std::filesystem::path& file);

/// Returns the library of a source. Compiles it if the cache has none for the same content of the
/// source and of its own headers, the same headers of the SDK, the same compiler and flags. The
/// compiler is $CXX, or else c++. The cache is hyperlattice/plugins in $XDG_CACHE_HOME, or else in
/// ~/.cache. A library comes into the cache complete, in one step.
CompiledPlugin compile_plugin(const std::filesystem::path& source);

}  // namespace hyperlattice
