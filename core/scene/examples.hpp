// Examples of values and stages, made from declarations; for documentation.
#pragma once

#include <base/option_set.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// A value that the option accepts: its default, or one made up.
Json example_value(const Option& option);

/// The smallest stage (or failure) with this component: its type and the required options.
Json example_stage(const ComponentInfo& info);

}  // namespace hyperlattice
