#include <base/descriptor.hpp>
#include <base/errors.hpp>
#include <base/folder_file.hpp>
#include <run/checkpoint.hpp>
#include <run/final_state.hpp>
#include <run/records.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view head_tag = "head", state_tag = "stat";
constexpr int version = 6;  // of the checkpoint's format

std::string text_of(const CheckpointHead& head) {
  nlohmann::json json{{"version", version},    {"identity", identity_json(head.identity)},
                      {"blocks", head.blocks}, {"at_start", head.at_start},
                      {"step", head.step},     {"time", head.time}};
  auto& tables = json["tables"] = nlohmann::json::array();
  for (const TableMark& table : head.tables)
    tables.push_back(
        {{"name", table.name}, {"bytes", table.extent.bytes}, {"hash", table.extent.hash}});
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

CheckpointHead read_head(RecordReader& records, const fs::path& file) {
  try {
    const auto json = nlohmann::json::parse(records.take_all(head_tag));
    if (json.at("version") != version)
      throw std::runtime_error(file.string() + ": a checkpoint of another version of the program");
    CheckpointHead head;
    head.identity = read_identity(json.at("identity"));
    head.blocks = json.at("blocks").get<std::int32_t>();
    head.at_start = json.at("at_start").get<bool>();
    head.step = json.at("step").get<std::uint64_t>();
    head.time = json.at("time").get<double>();
    for (const auto& table : json.at("tables"))
      head.tables.push_back(
          {table.at("name").get<std::string>(),
           {table.at("bytes").get<std::uint64_t>(), table.at("hash").get<std::string>()}});
    return head;
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error(file.string() + ": no checkpoint of this version of the program");
  }
}

/// Returns a checkpoint after reading it whole. Throws std::runtime_error if any byte is not as it
/// was written.
Checkpoint verified(const fs::path& file) {
  RecordReader::verify(file);
  RecordReader records(file);
  return {file, read_head(records, file)};
}

Checkpoint newest(const fs::path& directory) {
  std::vector<Fault> faults;
  for (const char* name : {checkpoint_file, earlier_checkpoint_file}) {
    const fs::path file = directory / name;
    if (!is_there(file)) continue;
    try {
      Checkpoint found = verified(file);
      if (!faults.empty())
        spdlog::warn("warning: {}; the run goes on from the checkpoint before it",
                     faults.front().expected);
      else if (name == earlier_checkpoint_file)
        spdlog::warn("warning: {} is missing; the run goes on from the checkpoint before it",
                     (directory / checkpoint_file).string());
      return found;
    } catch (const std::runtime_error& error) {
      faults.push_back({"--resume", file.string(), error.what()});
    }
  }
  for (Fault& fault : faults) fault.expected = "a checkpoint that is whole; " + fault.expected;
  throw InputError(std::move(faults));
}

}  // namespace

CheckpointHead checkpoint_head(const Plan& plan, bool at_start) {
  return {plan.identity, plan.blocks, at_start, 0, 0, {}};
}

Checkpoint find_checkpoint(const Plan& plan, const fs::path& directory) {
  Checkpoint found = newest(directory);
  if (const std::string changed = changes(found.head.identity, plan.identity); !changed.empty())
    throw InputError({{"--resume", found.file.string(),
                       "a checkpoint of this scene and of all that it uses, but " + changed +
                           ". A scene with a later end or other loads goes on from the end of a "
                           "run that --keep-state kept: see --from"}});
  return found;
}

void must_be_resumable(const fs::path& directory) {
  if (!is_there(directory / checkpoint_file) && !is_there(directory / earlier_checkpoint_file))
    throw InputError(
        {{"--resume", (directory / checkpoint_file).string(),
          "the checkpoint of a run that was cut off; there is none" + about_done_run(directory)}});
  if (!is_there(directory / own_files_list))
    throw InputError({{"--resume", (directory / own_files_list).string(),
                       "the list of the run's files; it was removed"}});
}

bool holds_progress(const fs::path& directory) {
  for (const char* name : {checkpoint_file, earlier_checkpoint_file}) {
    const fs::path file = directory / name;
    if (!is_there(file)) continue;
    try {
      RecordReader records(file);
      if (!read_head(records, file).at_start) return true;
    } catch (const std::runtime_error&) {
      return true;
    }
  }
  return false;
}

std::string place_of_checkpoint(const fs::path& directory) {
  for (const char* name : {checkpoint_file, earlier_checkpoint_file}) {
    const fs::path file = directory / name;
    if (!is_there(file)) continue;
    try {
      const CheckpointHead head = verified(file).head;
      if (head.at_start) return {};
      return fmt::format("step {}, t = {:.6g} s, in {}", head.step, head.time, file.string());
    } catch (const std::runtime_error&) {
      continue;
    }
  }
  return {};
}

void write_checkpoint(const fs::path& directory, const CheckpointHead& head, const Visit& state) {
  const fs::path path = directory / checkpoint_file;
  AtomicFile file(path.string());
  RecordWriter records(file);
  const std::string text = text_of(head);
  records.put(head_tag, text.data(), text.size());
  Archive archive([&](void* data, std::size_t size) { records.put(state_tag, data, size); }, false);
  if (!head.at_start) state(archive);
  records.end();
  file.sync();
  if (std::rename(path.c_str(), (directory / earlier_checkpoint_file).c_str()) != 0 &&
      errno != ENOENT)
    throw std::runtime_error(
        fmt::format("cannot rename {}: {}", path.string(), std::generic_category().message(errno)));
  file.commit();
  sync_directory(directory);
}

void read_checkpoint(const Checkpoint& checkpoint, const Visit& state) {
  RecordReader records(checkpoint.file);
  read_head(records, checkpoint.file);
  Archive archive([&](void* data, std::size_t size) { records.take(state_tag, data, size); }, true);
  state(archive);
}

void remove_checkpoints(const fs::path& directory) {
  for (const char* name : {earlier_checkpoint_file, checkpoint_file})
    if (::unlink((directory / name).c_str()) != 0 && errno != ENOENT)
      throw OutsideError(fmt::format("cannot remove {}: {}", (directory / name).string(),
                                     std::generic_category().message(errno)));
}

}  // namespace hyperlattice
