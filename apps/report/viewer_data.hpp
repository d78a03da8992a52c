// The numbers of a run's frames, as the page with the body in 3D holds them.
#pragma once

#include <report/frame_series.hpp>
#include <report/quantised.hpp>

namespace hyperlattice::report {

/// Largest size of the numbers in a page, bytes, as base64 text.
inline constexpr std::size_t largest_viewer_data = 58'000'000;

/// What the page holds.
struct ViewerData {
  /// particles; spacing, m; reference: places at rest, {min, max, at} of x, y and z, m; fields:
  /// name, unit, components, is_vector, and first, the number of their first array; frames: time,
  /// s, and arrays, {min, max, at} of each component of each field
  Json about;
  QuantisedNumbers numbers;
  std::vector<std::string> notes;  ///< sentences about what the page leaves out
};

/// Reads the frames of a run. Leaves frames out, evenly, if the page would be too large. Throws
/// InputError if the run has no frames, a frame cannot be read or does not match the first, or one
/// frame is too large for a page.
ViewerData read_viewer_data(const RunRecord& run);

}  // namespace hyperlattice::report
