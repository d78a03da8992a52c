// The frames that a run wrote as VTK files (.vtu).
#pragma once

#include <report/record.hpp>
#include <report/vtu_file.hpp>

namespace hyperlattice::report {

/// A file of the series.
struct FrameFile {
  std::filesystem::path name;  ///< relative to the run's folder
  double time = 0;             ///< s
};

/// The frames of one writer.
struct FrameSeries {
  std::string writer;        ///< name of the writer in the run
  bool is_deformed = false;  ///< whether points are displaced places
  std::vector<FrameFile> frames;
};

/// Finds the frames of the first writer of the run's scene that left a collection file (.pvd) with
/// .vtu files, in the order of that file. Throws InputError if there are none.
FrameSeries find_frames(const RunRecord& run);

/// Reads a frame of at most `most` particles. Throws InputError with the file's name if it is
/// missing, or is no such frame.
VtuFrame read_frame(const RunRecord& run, const FrameFile& file, std::size_t most);

}  // namespace hyperlattice::report
