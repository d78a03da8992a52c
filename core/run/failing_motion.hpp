// failing_motion.csv: how a body moves where a solver finds no state of rest, for each particle its
// place at rest and the motion, whose largest is 1.
#pragma once

#include <model/model.hpp>

#include <filesystem>
#include <span>

namespace hyperlattice {

inline constexpr const char* failing_motion_file = "failing_motion.csv";

/// motion: three numbers a particle; heights: one, or none at all. A motion of nothing leaves no
/// file. Throws std::runtime_error with the system's reason.
void write_failing_motion(const std::filesystem::path& directory, const Body& body,
                          std::span<const double> motion, std::span<const double> heights);

}  // namespace hyperlattice
