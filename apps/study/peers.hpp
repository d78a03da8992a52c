// Other programs in the same plot: their errors and run times, measured elsewhere.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice::study {

struct Peer {
  std::string label;  ///< those of one label are joined by a line
  double error = 0, seconds = 0;
};

/// Appends the rows of a CSV file with the columns label, error and seconds; more columns may stand
/// beside. What is wrong with it is added to the faults.
void append_peers(std::vector<Peer>& peers, const std::filesystem::path& file,
                  const std::string& pointer, Faults& faults);

}  // namespace hyperlattice::study
