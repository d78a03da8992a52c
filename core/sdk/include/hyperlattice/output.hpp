// Writers and probes read immutable snapshots and never change the run. The core decides when; it
// computes a field only if one of them asks for it.
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/field_table.hpp>

#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>

namespace hyperlattice {

/// A quantity of every particle (or of selected ones), `components` numbers each.
struct Field {
  std::uint32_t components = 0;  ///< 1, 3, 6 or 9
  std::span<const double> values;
};

/// The sum of forces, N, and the sum of their moments about a point, N m.
struct Resultant {
  Vec3 force, moment;
};

/// Forces that a probe asked for in begin(): see OutputContext.
struct ForcesId {
  std::uint32_t index = 0;
};

/// A plane section through a part of the body.
struct Section {
  /// Forces of the part beyond the plane, on the side of its normal, on the part before it.
  ForcesId forces;
  std::uint64_t springs = 0;  ///< how many springs the plane cuts at rest
  double area = 0;            ///< of the section at rest, m2; see PlaneSection in core/model
};

/// A face between two particles whose base spring is broken or damaged: a quadrilateral normal to
/// the undeformed spring, around its middle.
///   area = share |R| / m   of a spring of class 0, with m of PlaneSection
///   (core/model/section.hpp):
/// the square between two sites of the cubic lattice. Faces of a plane crack add up to the area of
/// its cross-section, each projected on the plane. In bodies of cells a face at the surface has a
/// quadrilateral for each of its cells, of a quarter of the square times the cell's share. Springs
/// of other classes, as the diagonals, cross the same crack: their area is 0, and they have a small
/// square with edges of a quarter of the spacing.
struct CrackFace {
  Particle a = 0, b = 0;           ///< ends of the spring; a precedes b
  std::uint32_t spring_class = 0;  ///< of the lattice; 0 in a list
  Vec3 corners[4];                 ///< at rest, m
  double area = 0;                 ///< at rest, m2
  double time = 0;    ///< when a criterion broke the spring or it softened fully, s; NaN: not yet
  double damage = 0;  ///< 1 - integrity: 1 for a broken spring
};

/// The body at rest as equal cubes of a grid, for pictures; see core/model/body_cubes.hpp.
struct BodyCubes {
  /// Marks a cube of the grid that is outside the body.
  static constexpr std::uint32_t no_particle = ~std::uint32_t{0};
  Vec3 origin;                 ///< low corner of the cube (0, 0, 0), m
  double edge = 0;             ///< m
  std::int32_t count[3] = {};  ///< cubes along each axis
  /// The particle of each cube, or no_particle; [(k * count[1] + j) * count[0] + i].
  std::span<const std::uint32_t> particle;
};

/// The body at one time. Particles are in the order z, y, x. Valid during the call that receives
/// it.
struct Snapshot {
  double time = 0;  ///< seconds
  std::uint64_t step = 0;
  std::uint64_t particles = 0;
  double spacing = 0;                 ///< lattice constant, metres
  std::span<const double> positions;  ///< x y z of each particle at rest, m
  void* self = nullptr;
  bool (*get_field)(void* self, std::string_view name, Field& field) noexcept = nullptr;
  Resultant (*get_resultant)(void* self, ForcesId forces, Vec3 about) noexcept = nullptr;
  /// Null, as in a copy of a frame: only the fields are known.
  bool (*get_fragments)(void* self, double damage, Field& numbers) noexcept = nullptr;
  std::span<const CrackFace> (*get_crack_faces)(void* self, double damage) noexcept = nullptr;
  BodyCubes (*get_cubes)(void* self) noexcept = nullptr;
  /// Calls task(work, n) for each n below `count`; null: the run has one thread for output.
  void (*run_tasks)(void* self, std::uint64_t count, void* work,
                    void (*task)(void* work, std::uint64_t n) noexcept) noexcept = nullptr;

  /// Gets a field by its name, in field_table or declared by a material of the run. A field is
  /// computed when it is first asked for. NaN: a particle has no such value. Returns false if this
  /// run has no such field.
  bool field(std::string_view name, Field& out) const { return get_field(self, name, out); }

  /// Calls task(n) for each n below `count`, in any order and on all threads that the run has for
  /// output. Rethrows the exception of the lowest n. A task asks for no field.
  template <class Task>
  void for_each(std::uint64_t count, const Task& task) const;

  /// Returns the field "fragment" of the pieces that remain if springs whose damage, 1 - integrity,
  /// is at least `damage` (above 0, at most 1) do not join their ends. For probes, and for writers
  /// that name no field. Valid until the next call. Throws std::runtime_error in other writers.
  std::span<const double> fragments(double damage) const {
    Field numbers;
    if (get_fragments == nullptr || !get_fragments(self, damage, numbers)) refuse_springs();
    return numbers.values;
  }

  /// Returns the faces of the springs that are broken, or whose damage is at least `damage`, in the
  /// order of their ends. For the same callers, valid as long, throws likewise.
  std::span<const CrackFace> crack_faces(double damage) const {
    if (get_crack_faces == nullptr) refuse_springs();
    return get_crack_faces(self, damage);
  }

  /// Returns the body at rest as cubes, valid during the call that received the snapshot. Throws
  /// std::runtime_error for a writer that names a field, as crack_faces() does.
  BodyCubes cubes() const {
    if (get_cubes == nullptr) refuse_springs();
    return get_cubes(self);
  }

  /// Returns the resultant of forces at this time. They act at the present places of the particles;
  /// `about`, m, is the point of the moment.
  Resultant resultant(ForcesId forces, Vec3 about) const {
    return get_resultant(self, forces, about);
  }

 private:
  [[noreturn]] static void refuse_springs() {
    throw std::runtime_error(
        "only probes, and writers that name no field, can ask for fragments, faces of cracks and "
        "cubes");
  }
};

/// A frame that the output folder already holds.
struct FrameMark {
  std::uint64_t step = 0;
  double time = 0;  ///< seconds
};

/// The folder for output, and facts about the body.
struct OutputContext {
  std::string_view directory;  ///< existing folder, without a slash at the end
  std::string_view title;
  /// Names of the fields that this run has; empty: known only to the snapshot.
  std::span<const std::string_view> fields;
  /// The frames of this writer that a resumed run already has, in order. The next frame follows
  /// them.
  std::span<const FrameMark> earlier;
  void* self = nullptr;
  std::span<const Particle> (*region_particles)(void* self, RegionId region) noexcept = nullptr;

  /// Receives the name of each file, relative to `directory`, before it is written. `rewritten`: a
  /// later frame writes the file again. Returns false if the file does not belong to the run and
  /// must not be touched; the run then tells the user. FrameFiles calls it.
  bool (*announce_file)(void* self, std::string_view name, bool rewritten) noexcept = nullptr;

  // The next three are for probes.
  std::span<const Particle> (*acted_particles)(void* self, LoadOrRegion of) noexcept = nullptr;
  ForcesId (*external_forces)(void* self, LoadOrRegion of) noexcept = nullptr;
  Section (*cut_section)(void* self, Vec3 point, Vec3 normal, RegionId region) noexcept = nullptr;
  /// Receives the name of a field that the writer's frames will ask for; see use().
  void (*use_field)(void* self, std::string_view name) noexcept = nullptr;
  /// Null: this body's are not known.
  std::span<const CrackFace> (*get_cut_faces)(void* self) noexcept = nullptr;

  /// Receives a sentence for warn(). A writer may call it until its end() returns. Null: nobody
  /// listens.
  void (*receive_warning)(void* self, std::string_view sentence) noexcept = nullptr;

  /// Returns the particles of the region in ascending order.
  std::span<const Particle> particles(RegionId region) const {
    return region_particles(self, region);
  }
  /// Returns the particles of the region, or those on which the load acts, in ascending order.
  std::span<const Particle> particles(LoadOrRegion of) const { return acted_particles(self, of); }
  /// Asks for the forces of a load on the body, or for those of all loads on the particles of a
  /// region. The force of a prescribed motion is its reaction: mass times prescribed acceleration,
  /// less all other forces on the particle. A body acceleration acts on every particle.
  ForcesId forces_on(LoadOrRegion of) const { return external_forces(self, of); }
  /// Cuts the region's part of the body by a plane through `point`, m. `normal` has any length.
  /// Particles on the plane are before it.
  Section section(Vec3 point, Vec3 normal, RegionId region) const {
    return cut_section(self, point, normal, region);
  }
  /// Tells the run, in begin() of a writer, that frames will ask for this field. The frames of a
  /// writer that names its fields are written beside the next steps, from copies of these fields;
  /// such a writer may ask for no other one. A writer that names no field delays the run while it
  /// writes. require_field() calls this function.
  void use(std::string_view name) const {
    if (use_field != nullptr) use_field(self, name);
  }
  /// Returns the faces of the springs that the lattice's cuts took away, in the order of their
  /// ends, with the time 0 and the damage 1. Valid during begin().
  std::span<const CrackFace> cut_faces() const {
    return get_cut_faces == nullptr ? std::span<const CrackFace>() : get_cut_faces(self);
  }
  /// Tells the user what a writer does not do as the scene asks, and why. The plan tells what
  /// begin() warns of, the run what frame() and end() warn of.
  void warn(std::string_view sentence) const {
    if (receive_warning != nullptr) receive_warning(self, sentence);
  }
  /// Announces a file. Throws std::runtime_error if the file must not be touched.
  void announce(std::string_view name, bool rewritten = false) const {
    if (announce_file != nullptr && !announce_file(self, name, rewritten))
      throw std::runtime_error(std::string(name) + " is not a file of this run");
  }
};

/// Functions of a writer across the boundary.
struct WriterFunctions {
  bool (*begin)(void* writer, const OutputContext& context, const Complaint& why) noexcept;
  bool (*frame)(void* writer, const Snapshot& snapshot, const Complaint& why) noexcept;
  bool (*end)(void* writer, const Complaint& why) noexcept;
  /// Null: the writer states none.
  double (*memory)(const void* writer) noexcept;
};

/// A writer class has begin(const OutputContext&), frame(const Snapshot&) and end(); each throws
/// std::runtime_error if the disk refuses. They are called one after the other, frame() perhaps on
/// another thread than the others. begin() writes nothing: the plan calls it too, without a
/// directory, to find errors before a run starts. A writer writes under a temporary name and
/// renames, so that no half-written file has a final name; after each frame the files on disk are
/// complete. It announces each file to the context, as FrameFiles does: only announced files belong
/// to the run. It may have double memory_bytes() const noexcept: the most memory that it allocates,
/// known after begin(). The plan counts it.
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

/// Functions of a probe across the boundary.
struct ProbeFunctions {
  bool (*begin)(void* probe, const OutputContext& context, const Snapshot& first,
                const ColumnSink& columns, const Complaint& why) noexcept;
  bool (*sample)(void* probe, const Snapshot& snapshot, double* row, const Complaint& why) noexcept;
};

/// A probe class has begin(const OutputContext&, const Snapshot&, const ColumnSink&), which names
/// its columns, and sample(const Snapshot&, double* row), which writes one number for each column.
/// The core writes the table, with the time as first column.
template <class T>
concept ProbeComponent = requires(T& probe, const OutputContext& context, const Snapshot& snapshot,
                                  const ColumnSink& columns, double* row) {
  probe.begin(context, snapshot, columns);
  probe.sample(snapshot, row);
};

namespace detail {

template <WriterComponent T>
constexpr auto memory_function_of() -> decltype(WriterFunctions::memory) {
  if constexpr (requires(const T& writer) { writer.memory_bytes(); })
    return
        [](const void* writer) noexcept { return static_cast<const T*>(writer)->memory_bytes(); };
  else
    return nullptr;
}

/// The tasks of Snapshot::for_each, and the first exception of one of them.
template <class Task>
struct SharedTasks {
  const Task& task;
  std::mutex failing{};
  std::uint64_t failed = std::numeric_limits<std::uint64_t>::max();
  std::exception_ptr failure{};

  void run(std::uint64_t n) noexcept {
    try {
      task(n);
    } catch (...) {
      const std::lock_guard lock(failing);
      if (n < failed) failure = std::current_exception();
      failed = n < failed ? n : failed;
    }
  }
};

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
      },
      memory_function_of<T>()};
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

template <class Task>
void Snapshot::for_each(std::uint64_t count, const Task& task) const {
  if (run_tasks == nullptr) {
    for (std::uint64_t n = 0; n < count; ++n) task(n);
    return;
  }
  detail::SharedTasks<Task> tasks{task};
  run_tasks(self, count, &tasks, [](void* work, std::uint64_t n) noexcept {
    static_cast<detail::SharedTasks<Task>*>(work)->run(n);
  });
  if (tasks.failure) std::rethrow_exception(tasks.failure);
}

}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
