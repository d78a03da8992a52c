// This plugin registers a table with one function missing.
#include "law.hpp"

struct Hollow : Law {
  using Law::Law;
};

template <>
struct hyperlattice::detail::FunctionsOf<Hollow> {
  static constexpr Family family = Family::failures;
  static constexpr FailureFunctions table{nullptr, nullptr,           false, false, 0,
                                          nullptr, {nullptr, nullptr}};
};

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Hollow>(); }
