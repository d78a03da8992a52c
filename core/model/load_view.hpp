// What a load sees of the body while it declares itself.
#pragma once

#include <host/plugin_call.hpp>
#include <model/model.hpp>
#include <model/region_index.hpp>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace hyperlattice {

/// The springs of cuts, by their ends, that loads have asked for. Each may have one load only.
using TakenCuts = std::set<std::pair<Particle, Particle>>;

/// The body as one load sees it.
class LoadView {
 public:
  /// All arguments must outlive the object.
  LoadView(const Model& model, RegionIndex& regions, const Stage& stage, TakenCuts& taken)
      : model_(model), regions_(regions), stage_(stage), taken_(taken) {}

  /// Returns the functions that the load may call; valid as long as the view.
  LoadBody body();
  /// The region that the load asked for and that has no particles, if there is one.
  std::optional<RegionId> empty;
  bool springs_unknown = false;  ///< springs were asked for, but the materials have faults

 private:
  std::span<const Particle> particles(RegionId region);
  std::span<const RestSpring> springs(RegionId region);
  std::span<const SeveredSpring> cut_springs(RegionId region);
  Particle existing(Particle particle) const;
  /// Calls `code` and returns its result to the load, or `otherwise` if `code` throws.
  template <class Result, class Code>
  static Result answer(void* self, Result otherwise, Code&& code) noexcept {
    return PluginCall::answer(otherwise,
                              [&]() -> Result { return code(*static_cast<LoadView*>(self)); });
  }

  const Model& model_;
  RegionIndex& regions_;
  const Stage& stage_;
  TakenCuts& taken_;
  std::map<std::uint32_t, std::vector<RestSpring>> springs_;
  std::map<std::uint32_t, std::vector<SeveredSpring>> cut_springs_;
};

}  // namespace hyperlattice
