// The text of the files in apps/report/viewer, which the build puts into the program.
#pragma once

#include <string_view>

namespace hyperlattice::report {

extern const std::string_view viewer_script, viewer_style, three_licence;

}  // namespace hyperlattice::report
