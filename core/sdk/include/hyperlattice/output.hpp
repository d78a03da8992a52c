// Writers and probes: they read immutable snapshots and never change the run. The core says when;
// fields are computed only if asked for.
#pragma once

#include <hyperlattice/component.hpp>

#include <stdexcept>

namespace hyperlattice {

/// A quantity of every particle (or of those asked for), `components` numbers each.
struct Field {
  std::uint32_t components = 0;  ///< 1 or 3
  std::span<const double> values;
};

/// The body at one time. Particles in the order z, y, x. Valid during the call that receives it.
struct Snapshot {
  double time = 0;  ///< seconds
  std::uint64_t step = 0;
  std::uint64_t particles = 0;
  double spacing = 0;                 ///< lattice constant, metres
  std::span<const double> positions;  ///< at rest, x y z of each particle, metres
  void* self = nullptr;
  bool (*get_field)(void* self, std::string_view name, Field& field) noexcept = nullptr;

  /// "displacement" (3, m), "velocity" (3, m/s), "height" (1, m: displacement in the fourth
  /// dimension), "material" (1), "source" (1: of a listed lattice, the particle's place in the
  /// lattice's own order, from 0), "broken_open", "broken_closed" (1: broken springs of the
  /// particle that are open, closed), "damage" (1: broken share of its springs). False: no such
  /// field in this run.
  bool field(std::string_view name, Field& out) const { return get_field(self, name, out); }
};

/// Names that Snapshot::field knows, for options that list fields.
inline constexpr std::string_view field_names[] = {"displacement",  "velocity", "height",
                                                   "material",      "source",   "broken_open",
                                                   "broken_closed", "damage"};

/// A frame that stands in the folder already.
struct FrameMark {
  std::uint64_t step = 0;
  double time = 0;  ///< seconds
};

/// Where output goes and what body it is about.
struct OutputContext {
  std::string_view directory;  ///< exists; ends without a slash
  std::string_view title;
  std::span<const std::string_view>
      fields;  ///< those of field_names that this run has; empty: only the snapshot tells
  std::span<const FrameMark> earlier;  ///< of a run that goes on: this writer's frames, in their
                                       ///< order; its next follows them
  void* self = nullptr;
  std::span<const Particle> (*region_particles)(void* self, RegionId region) noexcept = nullptr;

  /// Told the name of each file, relative to `directory`, before it is written. `rewritten`: a
  /// later frame writes the file again. False: a file of that name is not the run's own, and must
  /// not be touched; the run tells its user. FrameFiles asks it.
  bool (*announce_file)(void* self, std::string_view name, bool rewritten) noexcept = nullptr;

  std::span<const Particle> particles(RegionId region) const {
    return region_particles(self, region);
  }  ///< ascending
  /// Throws std::runtime_error if the file must not be touched.
  void announce(std::string_view name, bool rewritten = false) const {
    if (announce_file != nullptr && !announce_file(self, name, rewritten))
      throw std::runtime_error(std::string(name) + " is not a file of this run");
  }
};

struct WriterFunctions {
  bool (*begin)(void* writer, const OutputContext& context, const Complaint& why) noexcept;
  bool (*frame)(void* writer, const Snapshot& snapshot, const Complaint& why) noexcept;
  bool (*end)(void* writer, const Complaint& why) noexcept;
};

/// begin() writes nothing: the plan calls it too, with no directory, to find what does not fit
/// before a run is begun. A writer class has begin(const OutputContext&), frame(const Snapshot&),
/// end(); each throws std::runtime_error when the disk refuses. It writes under a temporary name
/// and renames, so that no half-written file stands under a final name; after each frame what is on
/// disk is complete. It announces each file to the context, as FrameFiles does: only announced
/// files are the run's own.
template <class T>
concept WriterComponent = requires(T& writer, const OutputContext& context,
                                   const Snapshot& snapshot) {
  writer.begin(context);
  writer.frame(snapshot);
  writer.end();
};

/// Receives the columns of a probe's table.
struct ColumnSink {
  void* self = nullptr;
  void (*receive)(void* self, std::string_view name) noexcept = nullptr;

  void column(std::string_view name) const { receive(self, name); }
};

struct ProbeFunctions {
  bool (*begin)(void* probe, const OutputContext& context, const Snapshot& first,
                const ColumnSink& columns, const Complaint& why) noexcept;
  bool (*sample)(void* probe, const Snapshot& snapshot, double* row, const Complaint& why) noexcept;
};

/// A probe class has begin(const OutputContext&, const Snapshot&, const ColumnSink&), which names
/// its columns, and sample(const Snapshot&, double* row), which fills one number a column. The core
/// writes the table, with the time in front.
template <class T>
concept ProbeComponent = requires(T& probe, const OutputContext& context, const Snapshot& snapshot,
                                  const ColumnSink& columns, double* row) {
  probe.begin(context, snapshot, columns);
  probe.sample(snapshot, row);
};

namespace detail {
template <WriterComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::writers;
  static constexpr WriterFunctions table{
      [](void* writer, const OutputContext& context, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(writer)->begin(context); });
      },
      [](void* writer, const Snapshot& snapshot, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(writer)->frame(snapshot); });
      },
      [](void* writer, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(writer)->end(); });
      }};
};

template <ProbeComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::probes;
  static constexpr ProbeFunctions table{
      [](void* probe, const OutputContext& context, const Snapshot& first,
         const ColumnSink& columns, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(probe)->begin(context, first, columns); });
      },
      [](void* probe, const Snapshot& snapshot, double* row, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<T*>(probe)->sample(snapshot, row); });
      }};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate, once all that a family hands over is known
