// A base spring breaks when its tensile force passes a limit:
//   k (|r| - |r0|) > limit
// The limit does not depend on the stiffness: in a body of two materials, the stiffer springs break
// at the smaller elongation.
#include <hyperlattice/failure.hpp>

namespace {
using namespace hyperlattice;

class Force {
 public:
  struct Options {
    double limit = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.force", "A spring breaks when it pulls with more than a force")
        .equation("k u_n > limit")
        .restrictions("for linear springs: the force is stiffness times elongation")
        .add<&Options::limit>("limit", "N", "force that breaks a base spring")
        .example("\"4 N\"")
        .positive();
  }

  explicit Force(const Options& options) : limit_(options.limit) {}

  double alarm(const SpringFacts& spring) const {
    return spring.stiffness > 0 ? limit_ / spring.stiffness : infinity;
  }
  bool breaks(const SpringFacts& spring, double elongation) const {
    return spring.stiffness * elongation > limit_;
  }

 private:
  double limit_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Force>(); }
