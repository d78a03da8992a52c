// A failure criterion whose alarm is twice the elongation at which its springs break.
#include <hyperlattice/failure.hpp>

namespace {
using namespace hyperlattice;

struct LateAlarm {
  struct Options {
    double limit = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("failures.late_alarm", "Breaks springs that nobody asks about")
        .add<&Options::limit>("limit", "m", "")
        .fallback("1e-6");
  }
  explicit LateAlarm(const Options& options) : limit(options.limit) {}
  double alarm(const SpringFacts&) const { return 2 * limit; }
  bool breaks(const SpringFacts&, double elongation) const { return elongation > limit; }

  double limit;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<LateAlarm>(); }
