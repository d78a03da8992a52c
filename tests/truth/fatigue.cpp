// A criterion with memory, written as a user would: a base spring breaks when it has been pulled
// above a strain for the given number of times. If it is strict, it throws when it is asked about a
// spring below its alarm.
#include <hyperlattice/failure.hpp>

#include <stdexcept>

namespace {
using namespace hyperlattice;

class Fatigue {
 public:
  struct Options {
    double limit = 0, cycles = 0;
    bool strict = false;
  };

  static Schema<Options> schema() {
    return Schema<Options>("failures.fatigue", "A spring breaks after a number of cycles")
        .add<&Options::limit>("limit", "", "strain above which a cycle counts")
        .example("1e-3")
        .positive()
        .add<&Options::cycles>("cycles", "", "cycles that break a base spring")
        .example("3")
        .positive()
        .add<&Options::strict>("strict", "", "whether a question below the alarm ends the run")
        .fallback("false");
  }

  explicit Fatigue(const Options& options) : o_(options) {}

  struct Memory {
    double cycles = 0;
    double asked = -1;  ///< time of the last review, s
  };
  double alarm(const SpringFacts& spring) const { return o_.limit * spring.rest_length; }
  bool breaks(const SpringFacts& spring, const AlarmedSpring& state, Memory& memory) const {
    if (!(state.elongation > alarm(spring))) {
      if (o_.strict) throw std::logic_error("asked below the alarm");
      return false;
    }
    // Not asked a step ago: the spring was below its alarm, so a new cycle begins.
    const bool begins = memory.asked < 0 || state.time - memory.asked > 1.5 * state.time_step;
    if (begins) memory.cycles += 1;
    memory.asked = state.time;
    return memory.cycles >= o_.cycles;
  }

 private:
  Options o_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Fatigue>(); }
