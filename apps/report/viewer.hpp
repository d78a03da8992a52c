// The section of the page that shows the body in 3D, in any browser with WebGL and without a
// network.
#pragma once

#include <report/record.hpp>

namespace hyperlattice::report {

/// Returns the section: style, the frames of the run, three.js with its licence, and the scripts of
/// apps/report/viewer. Throws OutsideError if three.js is not installed, and InputError as
/// read_viewer_data() does.
std::string viewer_section(const RunRecord& run);

}  // namespace hyperlattice::report
