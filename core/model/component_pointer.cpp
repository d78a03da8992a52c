#include <host/plugin_call.hpp>
#include <model/build.hpp>
#include <model/component_pointer.hpp>

namespace hyperlattice {

void Destroy::operator()(void* made) const {
  const PluginCall call(of->info.name, of->path.c_str(), "destructor");
  of->info.destroy(made);
}

ComponentPointer make_component(const Stage& stage) {
  ComponentPointer made{nullptr, Destroy{stage.component}};
  const auto refused = refusal_of(stage, "constructor", [&](const Complaint& why) {
    made.reset(stage.component->info.create(stage.options.get(), why));
    return made != nullptr;
  });
  if (refused) throw refusal(stage, *refused);
  return made;
}

}  // namespace hyperlattice
