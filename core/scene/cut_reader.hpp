// The key "cuts" of a lattice: surfaces whose crossing springs do not exist.
#pragma once

#include <scene/option_reader.hpp>

namespace hyperlattice {

/// Key of a lattice, and its help text.
inline constexpr std::string_view cuts_key = "cuts";
inline constexpr std::string_view cuts_help =
    "surfaces across which no spring acts from the start: notches, joints, cracks, borders of "
    "bodies that touch; a list of objects with one key out of plane, disc, polygon, discs, sheet, "
    "border. See docs/guide/cuts.md";

/// Reads the list of surfaces. `resolved` gets the same list with SI numbers. Returns nothing after
/// faults.
std::optional<std::vector<Cut>> read_cuts(const Json& given, const std::string& pointer,
                                          Reading reading, Json& resolved);

/// Returns the declaration of one corner of a polygon.
Option corner_option();

}  // namespace hyperlattice
