// The body at rest, as writers and probes see it when the plan tries them. All fields of the run
// are zero. It keeps what they ask for.
#pragma once

#include <model/acted_particles.hpp>
#include <plan/plan.hpp>

#include <hyperlattice/output.hpp>

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

class BodyAtRest {
 public:
  explicit BodyAtRest(const Model& model);
  BodyAtRest(const BodyAtRest&) = delete;  // the contexts point to it
  BodyAtRest& operator=(const BodyAtRest&) = delete;

  OutputContext context();
  std::span<const std::string_view> fields() const { return fields_; }
  std::span<const Particle> particles(RegionId region) { return regions_.particles(region); }
  /// Returns the snapshot for probes; writers do not need it.
  /// Throws OutsideError if there is no room for it, but InputError if there are faults.
  Snapshot snapshot(const Faults& faults);

  /// Forgets what an output has asked for, named and told.
  void forget();
  /// What they have asked for, named and told since then.
  const std::vector<RegionId>& asked_regions() const { return asked_regions_; }
  const std::vector<std::string>& used_fields() const { return used_fields_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  OutputNeeds needs() const;

 private:
  void check_room(const Faults& faults) const;
  bool field(std::string_view name, Field& field);

  const Model& model_;
  RegionIndex regions_;
  ActedParticles acted_;
  std::vector<std::string_view> fields_;
  std::vector<RegionId> asked_regions_;
  std::vector<std::string> used_fields_, warnings_;
  bool asked_forces_ = false;
  std::vector<CrackFace> cut_faces_;
  std::vector<double> positions_;
  std::map<std::uint32_t, std::vector<double>> zeros_;  ///< by number of components
};

}  // namespace hyperlattice
