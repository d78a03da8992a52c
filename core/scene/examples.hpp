// Examples of values and stages, made from declarations; for documentation.
#pragma once

#include <base/option_set.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// A value that the option accepts: its declared example, its default, or one made up. Vectors
/// along different axes differ.
Json example_value(const Option& option, std::size_t axis = 0);

/// A small stage (or failure) with this component: its type, the options that are required or have
/// an example, and what its cross-check asks for.
Json example_stage(const ComponentInfo& info);

}  // namespace hyperlattice
