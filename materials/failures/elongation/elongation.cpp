// A base spring breaks, at once and for good, when its elongation passes a limit:
//   u_n = |r| - |r0| > u_n*
// The limit is a length, the same for orthogonal and diagonal springs. The cross springs (beta,
// gamma) of a broken base spring break with it; alpha springs stay.
#include <hyperlattice/failure.hpp>

namespace {
using namespace hyperlattice;

class Elongation {
 public:
  struct Options {
    double limit = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.elongation",
                           "A spring breaks when it is longer by more than a limit")
        .equation("u_n = |r| - |r0| > limit")
        .source("Zhao 2017, section 3.2")
        .add<&Options::limit>(
            "limit", "m",
            "u_n*, the elongation that breaks a base spring, the same for every class")
        .example("\"1 um\"")
        .positive();
  }

  explicit Elongation(const Options& options) : limit_(options.limit) {}

  double alarm(const SpringFacts&) const { return limit_; }
  bool breaks(const SpringFacts&, double elongation) const { return elongation > limit_; }

 private:
  double limit_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Elongation>(); }
