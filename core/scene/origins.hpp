// The files that the parts of a scene come from. A scene may include files.
#pragma once

#include <base/errors.hpp>

#include <filesystem>
#include <map>
#include <string>

namespace hyperlattice {

/// The places in files that the parts of a document come from.
class Origins {
 public:
  Origins() = default;
  /// `file`: the file whose parts have no other origin. Its folder is that of the scene.
  explicit Origins(std::filesystem::path file) : file_(std::move(file)) {}

  /// Says that the part at `pointer` stands in `file`, at `own`.
  void add(const std::string& pointer, const std::filesystem::path& file, const std::string& own);
  /// Returns whether all parts come from one file.
  bool is_one_file() const { return parts_.empty(); }

  /// Returns the folder of the file in which the part at a pointer stands.
  std::filesystem::path folder_of(const std::string& pointer) const;
  /// Returns whether the part at a pointer stands in the scene's own file.
  bool is_of_main_file(const std::string& pointer) const;
  /// Returns the place for a message: the pointer, or "common.json:/pipeline/0" if several files
  /// were read.
  std::string place_of(const std::string& pointer) const;
  /// Returns the same error with such places.
  InputError with_places(const InputError& error) const;

 private:
  struct Place {
    std::filesystem::path file;
    std::string pointer;
  };
  Place find(const std::string& pointer) const;

  std::filesystem::path file_;
  std::map<std::string, Place> parts_;  // by pointer into the document
};

}  // namespace hyperlattice
