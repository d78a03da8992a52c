// A base spring breaks when its strain, its elongation over its rest length, passes a limit:
//   (|r| - |r0|) / |r0| > limit
// Orthogonal and diagonal springs then break at the same strain; failures.elongation would break
// both at the same elongation.
#include <hyperlattice/failure.hpp>

namespace {
using namespace hyperlattice;

class MyLaw {
 public:
  struct Options {
    double limit = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.my_law", "A spring breaks when its strain passes a limit")
        .equation("(|r| - |r0|) / |r0| > limit")
        .add<&Options::limit>("limit", "", "strain that breaks a base spring")
        .positive()
        .example("1e-3");
  }

  explicit MyLaw(const Options& options) : limit_(options.limit) {}

  // The elongation below which nothing can happen to a spring: while all are below, the run pays
  // nothing for this law.
  double alarm(const SpringFacts& spring) const { return limit_ * spring.rest_length; }

  // Asked for springs above their alarm only.
  bool breaks(const SpringFacts& spring, double elongation) const {
    return elongation > limit_ * spring.rest_length;
  }

 private:
  double limit_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<MyLaw>(); }
