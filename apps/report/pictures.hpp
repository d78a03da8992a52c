// The pictures that the writers of a run wrote.
#pragma once

#include <scene/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice::report {

/// One picture.
struct PictureFile {
  std::filesystem::path name;  ///< relative to the run's folder
  std::optional<double> time;  ///< s, from the text in the picture
};

/// The pictures of one writer, at most `most_pictures`: the first, the last and some evenly
/// between.
struct PictureSeries {
  std::string name;  ///< name of the writer
  std::vector<PictureFile> files;
  std::size_t count = 0;  ///< number of pictures found
};
inline constexpr std::size_t most_pictures = 6;

/// Finds the PNG pictures of each writer of the resolved scene that has an option `file` (names:
/// frames.hpp). A series ends before a picture whose time is less than the time before it or later
/// than the end of the run: an earlier run left that picture. Files of such a name that are links
/// or no PNG pictures are left out with a note; the files after them are shown.
std::vector<PictureSeries> find_pictures(const std::filesystem::path& folder, const Json& scene,
                                         std::optional<double> end_time,
                                         std::vector<std::string>& notes);

/// Returns the bytes of a picture; empty if the file is larger than largest_picture, or has changed
/// since find_pictures.
std::string read_picture(const std::filesystem::path& folder, const std::filesystem::path& name);

/// Returns the texts in the iTXt and tEXt chunks of a PNG picture before its first pixels, as
/// {keyword, text}, as far as `bytes` reach; empty if it is no PNG.
std::vector<std::pair<std::string, std::string>> png_texts(std::string_view bytes);

/// Returns `most` of `count` indices: the first, the last and others evenly between.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

}  // namespace hyperlattice::report
