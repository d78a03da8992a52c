// A failure criterion that does nothing. The bad plugins beside it use it; each has one fault only.
#pragma once

#include <hyperlattice/failure.hpp>

/// The type that a plugin registers. The compiler's flags set it.
#ifndef TYPE
#define TYPE "failures.unnamed"
#endif

struct Law {
  struct Options {
    double limit = 0;
  };
  static hyperlattice::Schema<Options> schema() {
    return hyperlattice::Schema<Options>(TYPE, "Breaks nothing")
        .add<&Options::limit>("limit", "m", "of no effect")
        .fallback("1");
  }
  explicit Law(const Options&) {}
  double alarm(const hyperlattice::SpringFacts&) const { return hyperlattice::infinity; }
  bool breaks(const hyperlattice::SpringFacts&, double) const { return false; }
};
