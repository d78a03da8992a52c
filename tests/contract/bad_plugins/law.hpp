// A failure law that does nothing, for the bad plugins beside it: each is sound but for one thing.
#pragma once

#include <hyperlattice/failure.hpp>

/// The name a plugin registers; fixed when it is compiled.
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
