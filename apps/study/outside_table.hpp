// The tables that a study reads as input.
#pragma once

#include <base/csv.hpp>
#include <base/errors.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice::study {

/// Reads an input table. Adds a fault at `pointer` for UTF-16 text, for rows whose number of cells
/// differs from the number of columns, and for repeated column names; the table is not usable then.
/// Throws InputError and OutsideError as read_input_file does.
CsvTable read_outside_table(const std::filesystem::path& file, const std::string& pointer,
                            const std::string& what, Faults& faults);

}  // namespace hyperlattice::study
