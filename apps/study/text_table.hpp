// Tables of text for a terminal.
#pragma once

#include <string>
#include <vector>

namespace hyperlattice::study {

/// Cells of a table by lines.
using Lines = std::vector<std::vector<std::string>>;

/// Returns the text without control characters that a terminal would act on.
std::string shown_whole(const std::string& text);

/// Returns lines with aligned columns; the first `left` columns are flush left, the others flush
/// right.
std::string aligned(const Lines& lines, std::size_t left);

}  // namespace hyperlattice::study
