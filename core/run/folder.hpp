// The folder of a run's results. It is locked while the run lives, and a list (files.csv) names the
// files in it that are the run's own: only these are removed before a new run, and these are what a
// resumed run counts on.
#pragma once

#include <base/errors.hpp>
#include <base/own_files.hpp>
#include <plan/file_names.hpp>
#include <run/table.hpp>

#include <list>
#include <memory>
#include <set>

namespace hyperlattice {

/// A table of the run and how far it had come at a checkpoint.
struct TableMark {
  std::string name;
  Extent extent;
};

class RunFolder {
 public:
  /// Opens and locks a folder, which a new run makes if it is not there. InputError if it is a
  /// study's, or if its list is no regular file. OutsideError if another run is writing there, or
  /// if the system refuses.
  RunFolder(std::filesystem::path directory, bool is_new);

  /// Whether an earlier run left something here.
  bool has_results() const { return !earlier_.empty(); }
  /// Begins a new run: removes what an earlier run left, if it is still as that run left it.
  /// InputError, with nothing touched, if an interrupted run is there or files of the run's own
  /// names that no list names, unless `overwrite`; in any case if one of the `inputs` would be
  /// removed or replaced, or if a folder, link, pipe or device stands where a file is to be
  /// written. `outputs`: what its writers and probes will write.
  void begin(bool overwrite, const std::vector<OutputName>& outputs,
             const std::vector<std::filesystem::path>& inputs = {});
  /// Goes on with a run whose checkpoint holds these marks. InputError, with nothing touched, if a
  /// table or file from before is not as it was, or if a folder, link, pipe or device stands where
  /// a file is to be written.
  void go_on(std::vector<TableMark> marks, const std::vector<OutputName>& outputs = {});

  const std::filesystem::path& directory() const { return directory_; }
  /// Makes a folder inside, or finds it. OutsideError if it is a link or file.
  std::filesystem::path subfolder(const std::string& name);
  /// Begins a table, or goes on with it from its mark. It lives as long as this object.
  Table& table(const std::string& name, const std::vector<std::string>& columns);
  /// Writes a whole file of the run's own.
  void write(const std::string& name, std::string_view text);
  /// Takes a name for a file of the run, before it is written. `rewritten`: it may change after the
  /// next checkpoint. OutsideError if a file of that name is there that is not the run's.
  void claim(const std::string& name, bool rewritten);

  /// Waits until everything that was written is on the disk. Returns where the tables, and the
  /// list, stand.
  std::vector<TableMark> sync();
  /// OutsideError if a table, or the list, was removed, replaced or changed by somebody else.
  void check_tables() const;
  /// Notes what the run's files hold at the end.
  void finish();

 private:
  struct Mine {
    bool rewritten = false, noted = false;  ///< noted: its hash is in the list
  };
  void note(const std::string& name, Mine& file, bool to_the_disk);
  void remove_leavings(const OwnFiles& files, bool overwrite, Faults& faults);
  std::set<std::string> met(const std::vector<OutputName>& outputs, Faults& faults) const;
  void refuse_losses(const std::set<std::string>& names,
                     const std::vector<std::filesystem::path>& inputs, bool overwrite,
                     Faults& faults) const;
  void remove_parts(const std::filesystem::path& folder) const;
  std::filesystem::path path_of(const std::string& name) const { return directory_ / name; }
  std::filesystem::path list_path() const { return directory_ / own_files_list; }

  std::filesystem::path directory_;
  std::unique_ptr<Table> list_;  ///< open and locked
  std::list<std::pair<std::string, Table>> tables_;
  std::vector<TableMark> marks_;
  std::map<std::string, Mine> mine_;
  OwnFiles earlier_;  ///< what the list said when the folder was opened
  bool may_replace_ = false;
};

}  // namespace hyperlattice
