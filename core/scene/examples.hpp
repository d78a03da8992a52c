// Examples of values and stages for documentation, made from declarations.
#pragma once

#include <base/option_set.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// Returns a value that the option accepts: its declared example, its default, or a generated one.
/// Generated vectors have different directions for different values of `axis`.
Json example_value(const Option& option, std::size_t axis = 0);

/// Returns a small stage (or failure) with this component: its type, all options that are required
/// or have an example, and options that its cross-check requires.
Json example_stage(const ComponentInfo& info);

}  // namespace hyperlattice
