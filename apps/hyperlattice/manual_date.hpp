// The date on the manual pages. CMake writes its value.
#pragma once

namespace hyperlattice {

/// The day of the release or, until then, of the configuration of the build: "2026-01-31".
extern const char* const manual_date;

}  // namespace hyperlattice
