// Reads the frames of a run: VTK files in XML (.vtu), whose arrays follow the text as raw
// binary data (core/vtk/include/vtk/encoded_array.hpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::report {

/// A field of a frame; `values` holds all components of the first particle, then the next.
struct VtuField {
  std::string name;
  std::vector<std::string> components;  ///< names of the components; one empty name of a number
  std::vector<double> values;           ///< SI
};

/// The content of a frame.
struct VtuFrame {
  std::size_t particles = 0;
  std::vector<double> points;  ///< x, y, z of each particle, m
  std::vector<VtuField> fields;
};

/// Reads a file with at most `most` particles. Throws std::runtime_error with what is wrong: no
/// such file, an array that is cut off, or too many particles.
VtuFrame read_vtu(std::string_view bytes, std::size_t most);

/// Returns an attribute of an XML tag, as `timestep` of `<DataSet timestep="0.1" .../>`; nothing if
/// the tag does not have it. The writers use no entities.
std::optional<std::string> attribute(std::string_view tag, std::string_view name);

/// Returns the text of each tag that begins with `<name `, in the order of the file.
std::vector<std::string_view> tags(std::string_view text, std::string_view name);

}  // namespace hyperlattice::report
