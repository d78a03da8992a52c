// Errors and run times of other programs, measured elsewhere, for the same plot.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice::study {

/// One result of another program.
struct Peer {
  std::string label;  ///< the plot joins points of the same label by a line
  double error = 0, seconds = 0;
};

/// Appends the rows of a CSV file with the columns label, error and seconds; further columns are
/// allowed. Adds a fault for each error in the file.
void append_peers(std::vector<Peer>& peers, const std::filesystem::path& file,
                  const std::string& pointer, Faults& faults);

}  // namespace hyperlattice::study
