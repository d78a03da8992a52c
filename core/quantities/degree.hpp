// The degree of an expression that is a polynomial.
#pragma once

#include <quantities/compiled.hpp>

#include <optional>

namespace hyperlattice {

/// Returns the degree of an expression as a polynomial of the inputs for which `is_variable` is
/// true; the other inputs are constants. Nothing if it is not written as a polynomial, or if its
/// degree is above 1000. `is_variable`: one entry for each input.
std::optional<int> degree_of(const Compiled& expression, std::span<const bool> is_variable);

}  // namespace hyperlattice
