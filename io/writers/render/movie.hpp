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

/// Makes a film of pictures in a folder, `rate` a second, under a temporary name, and renames it to
/// `file`. `pattern`: of the names of the pictures for ffmpeg, "frame_%06d.png"; `names`: all of
/// them, in order. Throws std::runtime_error with the program's answer if it fails.
void make_movie(const MovieMaker& maker, MovieKind kind, const std::string& folder,
                const std::string& pattern, const std::vector<std::string>& names, double rate,
                const std::string& file);

}  // namespace hyperlattice::render
