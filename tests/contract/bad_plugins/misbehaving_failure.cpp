// A failure criterion that commits the fault named in the environment; see fault.hpp.
#include "fault.hpp"

#include <hyperlattice/failure.hpp>

#include <stdexcept>

namespace {
using namespace hyperlattice;

/// Calls itself until the stack of its thread is full.
[[gnu::noinline]] double deeper(const volatile double* number) {
  volatile double room[100] = {*number};
  return *number < 1 ? deeper(number) + room[99] : 0;
}

struct BadCriterion {
  struct Options {
    double limit = 0;
  };
  static Schema<Options> schema() {
    Schema<Options> schema("failures.misbehaving", "Misbehaves");
    schema.add<&Options::limit>("limit", "", "strain")
        .positive()
        .example(asked_for("example") ? "1e-3 mm" : "1e-3");
    return schema;
  }
  explicit BadCriterion(const Options& options) : limit(options.limit) {}
  BadCriterion(const BadCriterion&) = delete;
  BadCriterion& operator=(const BadCriterion&) = delete;
  ~BadCriterion() {
    if (asked_for("null pointer in destructor")) *static_cast<volatile int*>(nullptr) = 1;
  }

  double alarm(const SpringFacts& spring) const {
    if (asked_for("throw in alarm")) throw std::runtime_error("oops");
    if (asked_for("alarm below the shortest")) return -infinity;
    return asked_for("nan alarm") ? infinity - infinity : limit * spring.rest_length;
  }
  bool breaks(const SpringFacts& spring, double elongation) const {
    if (asked_for("throw in breaks")) throw std::runtime_error("oops");
    if (asked_for("null pointer in breaks")) return *static_cast<const volatile bool*>(nullptr);
    if (asked_for("endless recursion in breaks")) {
      const volatile double number = 0;
      return deeper(&number) > 0;
    }
    return elongation > limit * spring.rest_length;
  }

  double limit;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<BadCriterion>(); }
