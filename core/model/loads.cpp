#include <base/visible.hpp>
#include <model/build.hpp>
#include <model/load_view.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace hyperlattice {

namespace {

constexpr Axes all_axes = 7;

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string axis_names(Axes axes) { return std::string(axis_set_names[axes - 1]); }

bool is_same(Vec3 a, Vec3 b) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(a) ==
         std::bit_cast<std::array<std::uint64_t, 3>>(b);
}

/// Adds particles behind the others. Particles that follow each other with one velocity, as those
/// of a body that flies without spin, are one entry.
void add_to(std::vector<StartVelocity>& all, Particle first, std::uint64_t count, Vec3 velocity) {
  velocity = Vec3{} + velocity;  // there is one zero
  if (!all.empty() && all.back().first + all.back().count == first &&
      is_same(all.back().velocity, velocity))
    all.back().count += count;
  else
    all.push_back({first, count, velocity});
}

/// Returns entries in the order of the particles, of which each has the sum of its velocities.
std::vector<StartVelocity> in_order(std::vector<StartVelocity> all) {
  const auto precedes = [](const StartVelocity& a, const StartVelocity& b) {
    return a.first < b.first;
  };
  const auto overlaps = [](const StartVelocity& a, const StartVelocity& b) {
    return a.first + a.count > b.first;
  };
  if (std::adjacent_find(all.begin(), all.end(), overlaps) == all.end()) return all;
  std::vector<Particle> bounds;
  for (const StartVelocity& one : all)
    bounds.insert(bounds.end(), {one.first, one.first + one.count});
  std::sort(bounds.begin(), bounds.end());
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  std::vector<StartVelocity> pieces;  // which begin and end at bounds
  for (const StartVelocity& one : all)
    for (auto bound = std::lower_bound(bounds.begin(), bounds.end(), one.first);
         *bound < one.first + one.count; ++bound)
      pieces.push_back({*bound, *(bound + 1) - *bound, one.velocity});
  std::stable_sort(pieces.begin(), pieces.end(), precedes);
  std::vector<StartVelocity> sums;
  for (auto piece = pieces.begin(); piece != pieces.end();) {
    const StartVelocity first = *piece;
    Vec3 velocity;
    for (; piece != pieces.end() && piece->first == first.first; ++piece)
      velocity += piece->velocity;
    add_to(sums, first.first, first.count, velocity);
  }
  return sums;
}

/// Receives the declarations of one load and merges them for each particle.
struct Collector {
  const Body& body;
  std::unordered_map<Particle, LoadedParticle> particles{};
  std::vector<WatchedParticle> watched{};
  std::set<Particle> watching{};
  std::vector<StartVelocity> start_velocities{};  ///< in the order of the calls
  std::vector<double> corners{};
  double frequency = 0;
  std::uint64_t memory = 0;
  Vec3 acceleration{};
  std::vector<std::string> warnings{};
  std::uint64_t warned = 0;  ///< number of warnings, including those that are not kept
  std::string fault{};       ///< first fault in the declarations

  LoadedParticle& at(Particle particle, Vec3 amplitude) {
    if (particle >= body.particles)
      throw std::out_of_range("it loads a particle that does not exist");
    if (!is_finite(amplitude)) throw std::range_error("it gives an amplitude that is not finite");
    LoadedParticle& loaded = particles[particle];
    loaded.particle = particle;
    return loaded;
  }

  static void prescribe(LoadedParticle& loaded, Axes axes, Axes& kind, Vec3& value,
                        Vec3 amplitude) {
    if (axes == 0 || (axes & ~all_axes) != 0)
      throw std::out_of_range("it prescribes an axis that does not exist, or none");
    if (((loaded.displaced | loaded.driven) & axes) != 0)
      throw std::invalid_argument("it prescribes an axis of a particle twice");
    kind |= axes;
    if (axes & 1U) value.x = amplitude.x;
    if (axes & 2U) value.y = amplitude.y;
    if (axes & 4U) value.z = amplitude.z;
  }

  /// Runs one call of the load. The first invalid value is stored as the fault, and later calls are
  /// ignored.
  template <class Code>
  static void take(void* self, Code&& code) noexcept {
    auto& collector = *static_cast<Collector*>(self);
    if (!collector.fault.empty()) return;
    PluginCall::answer([&] {
      try {
        code(collector);
      } catch (const std::logic_error& wrong) {
        collector.fault = wrong.what();
      } catch (const std::range_error& wrong) {
        collector.fault = wrong.what();
      }
    });
  }

  LoadSink sink() {
    LoadSink to;
    to.self = this;
    to.receive_force = [](void* self, Particle particle, Vec3 amplitude) noexcept {
      take(self, [&](Collector& c) {
        LoadedParticle& loaded = c.at(particle, amplitude);
        loaded.force += amplitude;
      });
    };
    to.receive_displacement = [](void* self, Particle particle, Axes axes,
                                 Vec3 amplitude) noexcept {
      take(self, [&](Collector& c) {
        LoadedParticle& loaded = c.at(particle, amplitude);
        prescribe(loaded, axes, loaded.displaced, loaded.displacement, amplitude);
      });
    };
    to.receive_velocity = [](void* self, Particle particle, Axes axes, Vec3 amplitude) noexcept {
      take(self, [&](Collector& c) {
        LoadedParticle& loaded = c.at(particle, amplitude);
        prescribe(loaded, axes, loaded.driven, loaded.velocity, amplitude);
      });
    };
    to.receive_acceleration = [](void* self, Vec3 value) noexcept {
      take(self, [&](Collector& c) {
        if (!is_finite(value))
          throw std::range_error("it gives an acceleration that is not finite");
        c.acceleration += value;
      });
    };
    to.receive_start_velocity = [](void* self, Particle particle, Vec3 velocity) noexcept {
      take(self, [&](Collector& c) {
        if (particle >= c.body.particles || !is_finite(velocity))
          throw std::range_error("it gives a start velocity that is not finite, or to no particle");
        add_to(c.start_velocities, particle, 1, velocity);
      });
    };
    to.receive_watched = [](void* self, Particle particle, bool answered,
                            const LoadStiffnessBound& reaction) noexcept {
      take(self, [&](Collector& c) {
        if (particle >= c.body.particles)
          throw std::out_of_range("it watches a particle that does not exist");
        if (!c.watching.insert(particle).second)
          throw std::invalid_argument("it watches a particle twice");
        if (!(reaction.stiffness >= 0 && reaction.viscosity >= 0 &&
              std::isfinite(reaction.stiffness + reaction.viscosity)))
          throw std::range_error("it gives a reaction that is negative or not finite");
        c.watched.push_back({particle, answered, reaction});
      });
    };
    to.receive_warning = [](void* self, std::string_view sentence) noexcept {
      take(self, [&](Collector& c) {
        constexpr std::size_t most = 20, longest = 4096;
        if (++c.warned <= most) c.warnings.push_back(visible_line(sentence, longest));
      });
    };
    to.receive_corner = [](void* self, double time) noexcept {
      take(self, [&](Collector& c) {
        if (std::isnan(time))
          throw std::range_error("it gives a corner at a time that is no number");
        if (time > 0 && std::isfinite(time)) c.corners.push_back(time);
      });
    };
    to.receive_frequency = [](void* self, double hertz) noexcept {
      take(self, [&](Collector& c) {
        if (!(hertz >= 0 && std::isfinite(hertz)))
          throw std::range_error("it gives a frequency that is negative or not finite");
        c.frequency = std::max(c.frequency, hertz);
      });
    };
    to.receive_memory = [](void* self, std::uint64_t numbers) noexcept {
      take(self, [&](Collector& c) {
        constexpr std::uint64_t most = std::uint64_t{1} << 40;
        if (numbers > most) throw std::length_error("it asks for more memory than there can be");
        c.memory += numbers;
      });
    };
    return to;
  }
};

std::vector<LoadedParticle> in_order(
    const std::unordered_map<Particle, LoadedParticle>& particles) {
  std::vector<LoadedParticle> all;
  all.reserve(particles.size());
  for (const auto& entry : particles) all.push_back(entry.second);
  std::sort(all.begin(), all.end(), [](const LoadedParticle& a, const LoadedParticle& b) {
    return a.particle < b.particle;
  });
  return all;
}

void sort_once(std::vector<double>& times) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

/// Whether both loads hold the particle where it is, along all of these axes: they agree at all
/// times, whatever their factors are.
bool both_hold(const LoadedParticle& a, const LoadedParticle& b, Axes axes) {
  const auto holds = [axes](const LoadedParticle& loaded) {
    const double amplitudes[3] = {std::abs(loaded.displacement.x), std::abs(loaded.displacement.y),
                                  std::abs(loaded.displacement.z)};
    for (unsigned axis = 0; axis < 3; ++axis)
      if ((axes >> axis & 1U) != 0 && amplitudes[axis] != 0) return false;
    return (axes & ~loaded.displaced) == 0;
  };
  return holds(a) && holds(b);
}

/// Two loads that prescribe one axis of one particle contradict each other, unless both hold it
/// where it is: then the earlier one does.
void check_conflicts(Model& model, Faults& faults) {
  struct Conflict {
    Axes axes = 0;
    std::uint64_t particles = 0;
    Particle first = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Conflict> conflicts;  // (earlier load, later load)
  std::unordered_map<Particle, std::array<std::size_t, 3>>
      prescribed_by;  // load + 1 of each axis; 0: free
  const auto of = [&](std::size_t load, Particle particle) {
    const auto& all = model.loads[load].particles;
    return *std::lower_bound(all.begin(), all.end(), particle,
                             [](const LoadedParticle& l, Particle p) { return l.particle < p; });
  };
  for (std::size_t later = 0; later < model.loads.size(); ++later)
    for (LoadedParticle& loaded : model.loads.all[later].particles) {
      const Axes axes = loaded.displaced | loaded.driven;
      if (axes == 0) continue;
      std::array<std::size_t, 3>& owners = prescribed_by[loaded.particle];
      std::map<std::size_t, Axes> shared;
      for (unsigned axis = 0; axis < 3; ++axis) {
        if ((axes >> axis & 1U) == 0) continue;
        if (owners[axis] != 0)
          shared[owners[axis] - 1] |= 1U << axis;
        else
          owners[axis] = later + 1;
      }
      for (const auto& [earlier, common] : shared) {
        if (both_hold(of(earlier, loaded.particle), loaded, common)) {
          loaded.displaced &= ~common;
          continue;
        }
        Conflict& conflict = conflicts[{earlier, later}];
        if (conflict.particles++ == 0) conflict.first = loaded.particle;
        conflict.axes |= common;
      }
    }
  for (const auto& [pair, conflict] : conflicts) {
    const Stage &earlier = *model.loads[pair.first].stage, &later = *model.loads[pair.second].stage;
    const Vec3 at = model.body.position(conflict.first);
    faults.add(later.pointer, later.component->type(),
               fmt::format("axes that no other load prescribes; {} of {} particles, the first at "
                           "({:.6g}, {:.6g}, {:.6g}) m, already follows {} ({})",
                           axis_names(conflict.axes), conflict.particles, at.x, at.y, at.z,
                           earlier.pointer, earlier.component->type()));
  }
}

}  // namespace

void add_loads(Model& model, RegionIndex& regions, Faults& faults) {
  std::vector<StartVelocity> start_velocities;
  TakenCuts taken;
  for (const Stage* stage : model.scene->of(Family::loads)) try {
      Load load;
      load.stage = stage;
      load.component = make_component(*stage);
      LoadView view(model, regions, *stage, taken);
      Collector collector{.body = model.body};
      const auto refused = refusal_of(*stage, "declare", [&](const Complaint& why) {
        return stage->functions<LoadFunctions>().declare(load.component.get(), view.body(),
                                                         collector.sink(), why);
      });
      if (view.empty) {
        faults.add(stage->pointer, stage->component->type(),
                   regions.expected_particles(*view.empty));
        continue;
      }
      if (view.springs_unknown) continue;
      if (!collector.fault.empty()) throw refusal(*stage, collector.fault);
      if (refused) throw objection(*model.scene, *stage, *refused);
      if (!collector.watched.empty() && stage->functions<LoadFunctions>().answer == nullptr)
        throw refusal(*stage, "it watches particles but has no answer");
      if (collector.memory > 0 && stage->functions<LoadFunctions>().update == nullptr)
        throw refusal(*stage, "it keeps numbers but has no update");
      load.watched = std::move(collector.watched);
      load.memory = collector.memory;
      model.loads.answering |= !load.watched.empty();
      load.particles = in_order(collector.particles);
      load.acceleration = collector.acceleration;
      model.loads.acceleration += load.acceleration;
      for (const StartVelocity& one : in_order(std::move(collector.start_velocities)))
        add_to(start_velocities, one.first, one.count, one.velocity);
      for (const std::string& warning : collector.warnings)
        model.warnings.push_back(fmt::format("{} ({}): {}", stage->name, stage->pointer, warning));
      if (const auto more = collector.warned - collector.warnings.size(); more > 0)
        model.warnings.push_back(
            fmt::format("{} ({}): and {} more such warnings", stage->name, stage->pointer, more));
      load.corners = std::move(collector.corners);
      sort_once(load.corners);
      load.frequency = collector.frequency;
      model.loads.corners.insert(model.loads.corners.end(), load.corners.begin(),
                                 load.corners.end());
      model.loads.all.push_back(std::move(load));
    } catch (const InputError& error) {
      add_all(faults, error);
    }
  check_conflicts(model, faults);
  model.loads.start_velocities = in_order(std::move(start_velocities));
  sort_once(model.loads.corners);
}

}  // namespace hyperlattice
