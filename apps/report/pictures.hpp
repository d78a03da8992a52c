// The pictures that a run's writers left.
#pragma once

#include <scene/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice::report {

struct PictureFile {
  std::filesystem::path name;  ///< relative to the run's folder
  std::optional<double> time;  ///< s, as the picture says
};

/// The pictures of one writer, at most `most_pictures`: the first, the last and some evenly
/// between.
struct PictureSeries {
  std::string name;  ///< of the writer
  std::vector<PictureFile> files;
  std::size_t count = 0;  ///< that there are
};
inline constexpr std::size_t most_pictures = 6;

/// Those of each writer of the resolved scene that has an option `file` and left PNG pictures of
/// that name (frames.hpp). Pictures that an earlier run left in the same folder are told by their
/// times: they fall back where they begin, or are later than the run's end. A file of such a name
/// that is no PNG picture, is a link, or is too large is left out, with a note, and those after it
/// are shown.
std::vector<PictureSeries> find_pictures(const std::filesystem::path& folder, const Json& scene,
                                         std::optional<double> end_time,
                                         std::vector<std::string>& notes);

/// A picture's bytes; empty if it is no longer what it was when it was found.
std::string read_picture(const std::filesystem::path& folder, const std::filesystem::path& name);

/// The texts in a PNG picture's iTXt and tEXt parts before its first pixels, as {keyword, text}; as
/// far as `bytes` reach. Empty if it is no PNG.
std::vector<std::pair<std::string, std::string>> png_texts(std::string_view bytes);

/// `most` of `count` indices: first, last and evenly between.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

}  // namespace hyperlattice::report
