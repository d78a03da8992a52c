// Tables that a user gives to a study.
#pragma once

#include <base/csv.hpp>
#include <base/errors.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice::study {

/// Reads a table that comes from outside. It adds a fault at `pointer` for a text in UTF-16, for
/// rows with more or fewer cells than there are columns and for a name that several columns have;
/// the table is then of no use. InputError and OutsideError as read_input_file.
CsvTable read_outside_table(const std::filesystem::path& file, const std::string& pointer,
                            const std::string& what, Faults& faults);

}  // namespace hyperlattice::study
