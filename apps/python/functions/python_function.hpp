// A Python function of a scene, as the components see it that call it. Nothing here knows Python:
// the module hyperlattice._core implements the class, and the components are a plugin, which any
// program can load.
#pragma once

#include <hyperlattice/array_failure.hpp>
#include <hyperlattice/load.hpp>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::python {

/// The particles on which a load acts: an entry of each array for each of them.
struct LoadedBody {
  std::span<const Particle> particles;
  std::span<const Vec3> positions;  ///< at rest, m
  std::span<const double> masses;   ///< kg
  std::span<const double> shares;   ///< fractions of a whole particle
};

/// A field of the particles of a frame: `components` numbers of each.
struct FrameField {
  std::string_view name;
  std::uint32_t components = 0;
  std::span<const double> values;
};

/// What a writer shows of one state.
struct ShownFrame {
  double time = 0;           ///< seconds
  std::uint64_t step = 0;    ///< of the run
  std::uint64_t number = 0;  ///< of the frame, from 0
  std::span<const Particle> particles;
  std::span<const double> positions;  ///< x y z at rest, m
  std::span<const FrameField> fields;
  /// Announces a file and returns its path. Throws std::runtime_error if the file must not be
  /// touched.
  std::function<std::string(const std::string& name)> announce;
};

/// All members may be called by any thread. Each throws std::runtime_error with a sentence if the
/// function raises an exception or returns something else than it must.
class PythonFunction {
 public:
  virtual ~PythonFunction() = default;
  /// Names the particles of the forces that follow.
  virtual void begin(const LoadedBody& body) = 0;
  /// Sets a force, N, for each particle.
  virtual void set_forces(const WatchedMotion& motion, std::span<Vec3> forces) = 0;
  /// Sets 1 for each spring that breaks.
  virtual void set_broken(const SpringArrays& springs, std::span<std::uint8_t> broken) = 0;
  virtual void write(const ShownFrame& frame) = 0;
};

/// Finds a function by its name in the scene that the present thread reads or runs; null: it has
/// none of this name.
using FindFunction = std::shared_ptr<PythonFunction> (*)(std::string_view name);

/// The symbol of the plugin that the module sets: a FindFunction, null in other programs.
inline constexpr const char* find_function_symbol = "hyperlattice_find_function";

}  // namespace hyperlattice::python
