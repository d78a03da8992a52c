#include <base/errors.hpp>
#include <run/checkpoint.hpp>
#include <run/summary.hpp>

#include <hyperlattice/chance.hpp>
#include <hyperlattice/files.hpp>

#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>

namespace hyperlattice {

namespace {

constexpr std::uint64_t mark = 0x31746e696f706b63;  // "ckpoint1"

std::uint64_t identity_of(const Plan& plan) {
  const nlohmann::json planned = plan_json(plan);
  const std::string text = plan.scene->resolved + planned.at("version").dump() + planned.at("plugins").dump();
  std::uint64_t sum = text.size();
  for (const char c : text) sum = mixed_bits(sum ^ static_cast<unsigned char>(c));
  return sum;
}

void visit_head(Archive& archive, CheckpointHead& head) {
  archive.same(mark, "it is no checkpoint of this version");
  archive(head.identity);
  archive(head.threads);
  archive(head.at_start);
}

Archive from(std::ifstream& file, const std::filesystem::path& path) {
  return {[&file, path](void* data, std::size_t size) {
            if (!file.read(static_cast<char*>(data), static_cast<std::streamsize>(size)))
              throw std::runtime_error(path.string() + ": the checkpoint is cut off");
          },
          true};
}

}  // namespace

CheckpointHead checkpoint_head(const Plan& plan, bool at_start) { return {identity_of(plan), plan.threads, at_start}; }

CheckpointHead read_checkpoint_head(const Plan& plan, const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / checkpoint_file;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({{"--resume", path.string(), "the checkpoint of a run that was cut off; there is none"}});
  CheckpointHead head;
  try {
    Archive archive = from(file, path);
    visit_head(archive, head);
  } catch (const std::runtime_error& error) {
    throw InputError({{"--resume", path.string(), error.what()}});
  }
  if (head.identity != identity_of(plan))
    throw InputError({{"--resume", path.string(), "a checkpoint of this scene, made by this version of the program and of its plugins"}});
  return head;
}

void write_checkpoint(const std::filesystem::path& directory, const CheckpointHead& head, const Visit& state) {
  AtomicFile file((directory / checkpoint_file).string());
  Archive archive([&](void* data, std::size_t size) { file.write({static_cast<const char*>(data), size}); }, false);
  CheckpointHead own = head;
  visit_head(archive, own);
  if (!head.at_start) state(archive);
  std::uint64_t sum = archive.sum();
  archive(sum);
  file.commit();
}

void read_checkpoint(const std::filesystem::path& directory, const Visit& state) {
  const std::filesystem::path path = directory / checkpoint_file;
  std::ifstream file(path, std::ios::binary);
  Archive archive = from(file, path);
  CheckpointHead head;
  visit_head(archive, head);
  if (!head.at_start) state(archive);
  const std::uint64_t sum = archive.sum();
  std::uint64_t there = 0;
  archive(there);
  if (there != sum) throw std::runtime_error(path.string() + ": the checkpoint is damaged");
}

}  // namespace hyperlattice
