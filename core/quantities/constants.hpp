// Named constants of an expression, as the options of components give them: "critical = 10 1/s".
#pragma once

#include <quantities/expression.hpp>

namespace hyperlattice {

/// Adds the constants of texts "name = quantity" to the names of an expression. A constant may use
/// those before it. Returns what was expected instead of the first wrong one; empty: all are right.
std::string add_constants(std::span<const std::string> texts, std::vector<ExpressionName>& names);

}  // namespace hyperlattice
