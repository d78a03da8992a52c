// Gravity, or the constant acceleration of a moving frame, on every particle from the start on:
//   F_i = m_i a
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class Gravity {
 public:
  struct Options {
    Vec3 acceleration;
  };

  static Schema<Options> schema() {
    return Schema<Options>("loads.gravity", "The same constant acceleration for all particles")
        .equation("F = m a")
        .add<&Options::acceleration>("acceleration", "m/s2", "of gravity")
        .fallback("[0, 0, -9.80665]");
  }

  explicit Gravity(const Options& options) : acceleration_(options.acceleration) {}

  void declare(const LoadBody&, const LoadSink& sink) const { sink.acceleration(acceleration_); }
  double factor(double) const { return 1; }

 private:
  Vec3 acceleration_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Gravity>(); }
