// A load whose factor is not a function of time: it falls with the number of calls. The work of its
// forces is counted as they act, so that the energy balance closes.
#include <hyperlattice/load.hpp>

namespace {
using namespace hyperlattice;

class Forgetful {
 public:
  struct Options {
    RegionId on;
  };
  static Schema<Options> schema() {
    return Schema<Options>("loads.forgetful", "Forces of 1 N that fall with each call")
        .add<&Options::on>("on", "", "where")
        .example("\"z_max\"");
  }
  explicit Forgetful(const Options& options) : options_(options) {}
  void declare(const LoadBody& body, const LoadSink& sink) {
    for (const Particle particle : body.particles(options_.on)) sink.force(particle, {0, 0, 1});
  }
  double factor(double /*time*/) const {
    calls_ += 1;
    return 1 / (1 + 1e-4 * calls_);
  }

 private:
  Options options_;
  mutable double calls_ = 0;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Forgetful>(); }
