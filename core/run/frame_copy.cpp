#include <host/plugin_call.hpp>
#include <plan/fields.hpp>
#include <run/frame_copy.hpp>
#include <run/writer_tasks.hpp>

#include <hyperlattice/fields.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

FrameCopy::FrameCopy(const Model& model, Team& team) : model_(model), team_(team) {}

void FrameCopy::take(SnapshotSource& source, const FieldNames& fields) {
  snapshot_ = source.latest();
  snapshot_.self = this;
  snapshot_.get_field = [](void* self, std::string_view name, Field& out) noexcept {
    return PluginCall::answer(false,
                              [&] { return static_cast<FrameCopy*>(self)->field(name, out); });
  };
  snapshot_.get_fragments = nullptr;  // the state goes on
  snapshot_.get_crack_faces = nullptr;
  snapshot_.get_cubes = nullptr;
  snapshot_.run_tasks = [](void* self, std::uint64_t count, void* work,
                           void (*task)(void* work, std::uint64_t n) noexcept) noexcept {
    run_writer_tasks(static_cast<FrameCopy*>(self)->team_, count, work, task);
  };
  for (auto& [name, values] : fields_) values.current = is_constant_field(name);
  for (const std::string& name : fields)
    if (FieldValues& values = fields_[name]; !values.current) source.hand_over(name, values);
}

bool FrameCopy::field(std::string_view name, Field& out) const {
  if (!has_field(model_, name)) return false;
  const auto found = fields_.find(name);
  if (found == fields_.end() || !found->second.current)
    throw PluginMistake(
        fmt::format("it asked for the field \"{}\", which it did not name in begin()", name));
  out = {found->second.components, found->second.numbers};
  return true;
}

}  // namespace hyperlattice
