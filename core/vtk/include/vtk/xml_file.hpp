// A file of VTK in XML, whose arrays follow the text as raw binary data, and the collection file
// that gives the files of a series their times.
#pragma once

#include <vtk/encoded_array.hpp>
#include <vtk/packing_options.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::vtk {

/// Returns the name of VTK for numbers of these digits: "Float32" or "Float64".
std::string_view real_type(Digits digits);

/// Encodes real numbers with these digits.
void encode(const Snapshot& snapshot, const PackingOptions& options, std::span<const double> values,
            EncodedArray& array);

/// The text of a file and its arrays, which must outlive it.
class XmlFile {
 public:
  /// Begins a file of a type of VTK, such as "PolyData".
  XmlFile(std::string_view type, Codec codec);

  /// Adds text.
  XmlFile& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  /// Adds the element of an array. `type`: "Float32", "Int64", ...; `attributes` as in XML, with a
  /// blank before each: see components().
  void add(std::string_view type, std::string_view name, std::string_view attributes,
           const EncodedArray& array);
  /// Ends the element of the type and writes the file. Throws std::runtime_error if the disk
  /// refuses.
  void write(const std::string& path) const;

 private:
  std::string type_, text_;
  std::vector<const EncodedArray*> arrays_;
  std::size_t appended_ = 0;  ///< bytes of the arrays
};

/// Returns the attribute for numbers of several components: ` NumberOfComponents="3"`.
std::string components(std::uint32_t count);

/// The files of a series and their times, in s.
class Collection {
 public:
  void add(std::string_view file, double time);
  /// Writes the collection file with all entries so far. Throws std::runtime_error if the disk
  /// refuses.
  void write(const std::string& path) const;

 private:
  std::string entries_;
};

}  // namespace hyperlattice::vtk
