// A base spring breaks when its strain (elongation over rest length) passes a limit:
//   (|r| - |r0|) / |r0| > limit
// Springs of all classes then break at the same strain; with failures.elongation they break at the
// same elongation.
#include <hyperlattice/failure.hpp>

namespace {
using namespace hyperlattice;

class Strain {
 public:
  struct Options {
    double limit = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.strain", "A spring breaks when its strain passes a limit")
        .equation("(|r| - |r0|) / |r0| > limit")
        .add<&Options::limit>(
            "limit", "",
            "elongation over rest length that breaks a base spring, the same for every class")
        .example("1e-3")
        .positive();
  }

  explicit Strain(const Options& options) : limit_(options.limit) {}

  double alarm(const SpringFacts& spring) const { return limit_ * spring.rest_length; }
  bool breaks(const SpringFacts& spring, double elongation) const {
    return elongation > limit_ * spring.rest_length;
  }

 private:
  double limit_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Strain>(); }
