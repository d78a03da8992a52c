// The files on which a scene depends, found by their names in it, without opening a plugin.
#pragma once

#include <base/descriptor.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace hyperlattice {

/// Watches the scene, and each file or folder of plugins that has its name in a text of the scene,
/// of an included file or of a setting; of a source file also the headers that it includes in
/// quotes. Names are relative to the folder of the file in which they are. A file that is named but
/// does not exist yet is watched, too.
class WatchedFiles {
 public:
  /// `others`: files besides those that the scene names. Throws OutsideError if the system refuses
  /// to watch files.
  WatchedFiles(std::filesystem::path scene, const std::vector<std::string>& settings,
               const std::vector<std::filesystem::path>& others);

  /// Returns a descriptor that can be read when something happened in a folder of these files.
  int descriptor() const { return events_.number(); }
  /// Forgets what happened so far.
  void forget_events();
  /// Returns whether the size, time or number of a file differs from what find_changes() saw. Reads
  /// no file.
  bool seem_changed() const;
  /// Reads the names again. Returns the files that were known and whose content, or existence, is
  /// no longer what the last call saw.
  std::vector<std::filesystem::path> find_changes();

 private:
  /// What the system says about a file; equal as long as the file was not written.
  struct Status {
    bool exists = false;
    std::uint64_t number = 0, device = 0, bytes = 0;
    std::int64_t seconds = 0, nanoseconds = 0;
    bool operator==(const Status&) const = default;
  };
  struct Known {
    Status status;
    std::string content;  ///< hash of it
  };
  using Paths = std::set<std::filesystem::path>;

  static Status status_of(const std::filesystem::path& file);
  Paths named_files() const;
  void add_names(const std::filesystem::path& file, Paths& found) const;
  void add_name(const std::filesystem::path& folder, const std::string& name, Paths& found) const;
  void watch_folders();

  std::filesystem::path scene_;
  Paths always_;  ///< the scene and the others
  std::vector<std::string> settings_;
  Descriptor events_;
  std::map<std::filesystem::path, Known> known_;
};

}  // namespace hyperlattice
