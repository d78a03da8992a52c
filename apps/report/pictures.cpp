#include <base/csv.hpp>
#include <base/folder_file.hpp>
#include <report/pictures.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace hyperlattice::report {

namespace fs = std::filesystem;

namespace {

// Bytes to read from the start of a picture; its texts are before the pixels.
constexpr std::size_t head_bytes = 4096;
constexpr std::size_t most_told = 3;  // notes of each writer about files that are not shown
constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

/// Returns the time of a picture, s, from its text, as "1e-05 s".
std::optional<double> time_of(std::string_view head) {
  for (const auto& [key, text] : png_texts(head))
    if (key == "Time") return csv_number(std::string_view(text).substr(0, text.find(' ')));
  return std::nullopt;
}

/// Returns why a file cannot be shown as a picture; empty if it can.
std::string fault_of(const FolderFile& file) {
  if (!file.refusal.empty()) return file.refusal;
  return file.text.starts_with(signature) ? "" : "no PNG picture";
}

/// Returns whether a file is in the folder or its subfolders, without a link on its path. An error
/// of the path is the same for every frame.
bool stands_inside(const fs::path& folder, const fs::path& name) {
  fs::path way = folder;
  std::error_code error;
  for (const fs::path& part : name.parent_path())
    if (part == ".." || part == "." || !fs::is_directory(fs::symlink_status(way /= part, error)))
      return false;
  return !name.is_absolute();
}

/// Returns the frames of a writer in their order, without those that cannot be shown.
std::vector<PictureFile> frames(const fs::path& folder, const fs::path& base, double end_time,
                                std::vector<std::string>& notes) {
  std::vector<PictureFile> found;
  std::optional<double> last;
  std::size_t left_out = 0;
  for (std::size_t n = 0;; ++n) {
    PictureFile picture{fs::path(fmt::format("{}_{:06}.png", base.string(), n)), std::nullopt};
    const auto file = read_folder_file(folder, picture.name, head_bytes, true);
    if (!file) break;
    if (const std::string fault = fault_of(*file); !fault.empty()) {
      if (++left_out <= most_told)
        notes.push_back(
            fmt::format("{} is {}, and is not shown.", picture.name.generic_string(), fault));
      if (!stands_inside(folder, picture.name)) break;
      continue;
    }
    picture.time = time_of(file->text);
    if (picture.time && ((last && *picture.time < *last) || *picture.time > end_time)) break;
    if (picture.time) last = picture.time;
    found.push_back(std::move(picture));
  }
  if (left_out > most_told)
    notes.push_back(fmt::format("{} more files of the pictures {} are not shown.",
                                left_out - most_told, base.generic_string()));
  return found;
}

}  // namespace

std::string read_picture(const fs::path& folder, const fs::path& name) {
  auto file = read_folder_file(folder, name, largest_picture);
  return file && fault_of(*file).empty() ? std::move(file->text) : std::string();
}

std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t kept = std::min(count, most);
  for (std::size_t n = 0; n < kept; ++n)
    chosen.push_back(kept == 1 ? count - 1 : (n * (count - 1) + (kept - 1) / 2) / (kept - 1));
  return chosen;
}

std::vector<std::pair<std::string, std::string>> png_texts(std::string_view bytes) {
  std::vector<std::pair<std::string, std::string>> texts;
  if (!bytes.starts_with(signature)) return texts;
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t n = 0; n < 4; ++n)
      length = length << 8 | static_cast<unsigned char>(bytes[at + n]);
    const std::string_view kind = bytes.substr(at + 4, 4);
    if (kind == "IDAT" || at + 12 + length > bytes.size()) break;
    const std::string_view content = bytes.substr(at + 8, length);
    const auto end = content.find('\0');
    if (kind == "tEXt" && end != std::string_view::npos)
      texts.emplace_back(content.substr(0, end), content.substr(end + 1));
    if (kind == "iTXt" && end != std::string_view::npos && end + 2 < content.size() &&
        content[end + 1] == 0) {  // not compressed
      const auto language = content.find('\0', end + 3),
                 translated = content.find('\0', language + 1);
      if (language != std::string_view::npos && translated != std::string_view::npos)
        texts.emplace_back(content.substr(0, end), content.substr(translated + 1));
    }
    at += 12 + length;
  }
  return texts;
}

std::vector<PictureSeries> find_pictures(const fs::path& folder, const Json& scene,
                                         std::optional<double> end_time,
                                         std::vector<std::string>& notes) {
  constexpr double rounding = 1e-9, always = std::numeric_limits<double>::infinity();
  std::vector<PictureSeries> all;
  if (!scene.is_object() || !scene.contains("pipeline")) return all;
  for (const Json& stage : scene["pipeline"]) {
    const std::string type = word_in(stage, "type"), file = word_in(stage, "file");
    if (!type.starts_with("writers.") || file.empty()) continue;
    PictureSeries series{word_in(stage, "name"), {}, 0};
    // A writer with a label writes into a folder of that name.
    const bool is_labelled = series.name != type.substr(type.find('.') + 1);
    const auto found = frames(folder, is_labelled ? fs::path(series.name) / file : fs::path(file),
                              end_time ? *end_time * (1 + rounding) : always, notes);
    series.count = found.size();
    for (const std::size_t n : evenly(found.size(), most_pictures))
      series.files.push_back(found[n]);
    if (series.count > 0) all.push_back(std::move(series));
  }
  return all;
}

}  // namespace hyperlattice::report
