// failing_motion.csv: the motion of a body for which a solver finds no state of rest. For each
// particle it has the place at rest, m, and the motion, whose largest displacement is 1.
#pragma once

#include <model/model.hpp>

#include <filesystem>
#include <span>

namespace hyperlattice {

inline constexpr const char* failing_motion_file = "failing_motion.csv";

/// Writes the file from three numbers of motion per particle and one height per particle or none at
/// all. Writes no file if the motion is zero. Throws std::runtime_error with the system's reason.
void write_failing_motion(const std::filesystem::path& directory, const Body& body,
                          std::span<const double> motion, std::span<const double> heights);

}  // namespace hyperlattice
