#include <base/csv.hpp>
#include <base/folder_file.hpp>
#include <report/frame_series.hpp>

#include <stdexcept>

namespace hyperlattice::report {

namespace fs = std::filesystem;

namespace {

std::vector<FrameFile> frames_in(std::string_view collection, const fs::path& folder) {
  std::vector<FrameFile> frames;
  for (const std::string_view tag : tags(collection, "DataSet")) {
    const auto time = csv_number(attribute(tag, "timestep").value_or(""));
    const auto name = attribute(tag, "file");
    if (time && name && name->ends_with(".vtu")) frames.push_back({folder / *name, *time});
  }
  return frames;
}

}  // namespace

FrameSeries find_frames(const RunRecord& run) {
  const Json none = Json::array();
  for (const Json& stage : run.scene.is_object() ? run.scene.value("pipeline", none) : none) {
    const std::string type = word_in(stage, "type"), base = word_in(stage, "file");
    if (!type.starts_with("writers.") || base.empty()) continue;
    FrameSeries series;
    series.writer = word_in(stage, "name");
    series.is_deformed = stage.contains("deformed") && stage["deformed"] == true;
    // A writer with a label writes into a folder of that name.
    const fs::path folder =
        series.writer == type.substr(type.find('.') + 1) ? fs::path() : fs::path(series.writer);
    const auto file = read_folder_file(run.folder, folder / (base + ".pvd"), largest_table);
    if (file && file->refusal.empty()) series.frames = frames_in(file->text, folder);
    if (!series.frames.empty()) return series;
  }
  throw InputError({{"--interactive", run.folder.string(),
                     "a run with frames (.vtu and .pvd), which a writer of its scene left"}});
}

VtuFrame read_frame(const RunRecord& run, const FrameFile& file, std::size_t most) {
  const auto bytes = read_folder_file(run.folder, file.name, largest_table);
  const std::string path = (run.folder / file.name).string();
  if (!bytes) throw InputError({{path, "", "a file, which the series names"}});
  if (!bytes->refusal.empty()) throw InputError({{path, bytes->refusal, "a regular file"}});
  try {
    return read_vtu(bytes->text, most);
  } catch (const std::runtime_error& fault) {
    throw InputError({{path, "", fault.what()}});
  }
}

}  // namespace hyperlattice::report
