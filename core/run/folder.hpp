// The folder of a run's results. It is locked while the run lives. A list (files.csv) names the
// run's own files: a new run removes only these, and a resumed run relies on these.
#pragma once

#include <base/errors.hpp>
#include <base/own_files.hpp>
#include <plan/file_names.hpp>
#include <run/table.hpp>

#include <list>
#include <memory>
#include <mutex>
#include <set>

namespace hyperlattice {

/// A table of the run and its extent at a checkpoint.
struct TableMark {
  std::string name;
  Extent extent;
};

class RunFolder {
 public:
  /// Opens and locks a folder; a new run makes it if needed. Throws InputError if a new run would
  /// use a study's folder, or if its list is no regular file. Throws OutsideError if another run is
  /// writing there, or if the system refuses.
  RunFolder(std::filesystem::path directory, bool is_new);
  /// The folder in which another rank writes: nothing is read or written here.
  explicit RunFolder(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// Returns whether an earlier run left results here.
  bool has_results() const { return !earlier_.empty(); }
  /// Begins a new run: removes the files of an earlier run. Throws InputError and changes nothing
  /// in these cases. Unless `overwrite`: the folder has an interrupted run, changed files of an
  /// earlier run, or files with the run's own names that no list names. Always: one of the `inputs`
  /// would be removed or replaced, or a folder, link, pipe or device has the name of a file to be
  /// written. `outputs`: the files of its writers and probes.
  void begin(bool overwrite, const std::vector<OutputName>& outputs,
             const std::vector<std::filesystem::path>& inputs = {});
  /// Continues a run whose checkpoint has these marks. Throws InputError and changes nothing if an
  /// earlier table or file has changed, or if a folder, link, pipe or device has the name of a file
  /// to be written.
  void go_on(std::vector<TableMark> marks, const std::vector<OutputName>& outputs = {});

  const std::filesystem::path& directory() const { return directory_; }
  /// Returns a folder inside this one; makes it if needed. Throws OutsideError if a link or file
  /// has its name.
  std::filesystem::path subfolder(const std::string& name);
  /// Begins a table, or continues it from its mark. The table lives as long as this object.
  Table& table(const std::string& name, const std::vector<std::string>& columns);
  /// Writes a whole file of the run's own.
  void write(const std::string& name, std::string_view text);
  /// Lists a file as the run's before it is written. `rewritten`: it may change after the next
  /// checkpoint. Throws OutsideError if a file of that name exists that is not the run's. Two
  /// threads may call it at once; while one calls it, no other member may be called.
  void claim(const std::string& name, bool rewritten);

  /// Waits until all written data is on the disk. Returns the extents of the tables and of the
  /// list.
  std::vector<TableMark> sync();
  /// Throws OutsideError if another program removed, replaced or changed a table or the list.
  void check_tables() const;
  /// Adds the final sizes and hashes of the run's files to the list.
  void finish();

 private:
  struct ListedFile {
    bool rewritten = false, noted = false;  ///< noted: its hash is in the list
  };
  void note(const std::string& name, ListedFile& file, bool to_the_disk);
  void remove_earlier_files(const OwnFiles& files, bool overwrite, Faults& faults);
  std::set<std::string> met(const std::vector<OutputName>& outputs, Faults& faults) const;
  void refuse_losses(const std::set<std::string>& names,
                     const std::vector<std::filesystem::path>& inputs, bool overwrite,
                     Faults& faults) const;
  void remove_parts(const std::filesystem::path& folder) const;
  std::filesystem::path path_of(const std::string& name) const { return directory_ / name; }
  std::filesystem::path list_path() const { return directory_ / own_files_list; }

  std::filesystem::path directory_;
  std::unique_ptr<Table> list_;  ///< open and locked; null: another rank writes
  std::list<std::pair<std::string, Table>> tables_;
  std::vector<TableMark> marks_;
  std::mutex claiming_;
  std::map<std::string, ListedFile> files_;
  OwnFiles earlier_;  ///< content of the list when the folder was opened
  bool may_replace_ = false;
};

}  // namespace hyperlattice
