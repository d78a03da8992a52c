// Films of the frames, by ffmpeg or ImageMagick if they are installed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::render {

enum class MovieKind : std::uint32_t { none, mp4, gif, webp };
inline constexpr std::string_view movie_names[] = {"none", "mp4", "gif", "webp"};

/// A program that makes films, found in PATH.
struct MovieMaker {
  std::string program;  ///< its path
  bool is_ffmpeg = false;
};

/// Returns the program for a kind of film: ffmpeg, or for gif and webp ImageMagick (magick,
/// convert); nothing if there is none.
std::optional<MovieMaker> find_movie_maker(MovieKind kind);

/// The pictures of a film.
struct MovieFrames {
  std::string folder;
  std::string pattern;             ///< of their names, for ffmpeg: "frame_%06d.png"
  std::vector<std::string> names;  ///< without the folder, in order
  double rate = 0;                 ///< frames per second
};

/// Makes a film of a folder's pictures under a temporary name in the folder, and renames it to
/// `file`, a path. Throws std::runtime_error with the program's answer if the program fails.
void make_movie(const MovieMaker& maker, MovieKind kind, const MovieFrames& frames,
                const std::string& file);

}  // namespace hyperlattice::render
