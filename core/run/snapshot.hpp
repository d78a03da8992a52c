// The view of a running simulation that writers and probes get.
#pragma once

#include <model/body_cubes.hpp>
#include <run/measured.hpp>

#include <hyperlattice/output.hpp>

#include <exception>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace hyperlattice {

/// The numbers of a field at one time.
struct FieldValues {
  std::uint32_t components = 1;
  bool current = false;  ///< they are those of the present state
  std::vector<double> numbers;
};

/// Makes snapshots of the present state. Computes a field, or the forces of loads, only when an
/// output asks for it, once for each state.
class SnapshotSource {
 public:
  SnapshotSource(const Model& model, Simulation& simulation);
  SnapshotSource(const SnapshotSource&) = delete;
  SnapshotSource& operator=(const SnapshotSource&) = delete;

  /// Forgets what was computed of the present state, and frees it.
  void renew();
  /// Returns the present state, valid until the next call of renew() or step. Use it in a
  /// PluginCall, which keeps the exceptions of its fields.
  const Snapshot& take();
  /// Returns the state of the latest take().
  const Snapshot& latest() const { return snapshot_; }
  /// Puts a field of the present state, which is that of the latest take(), into `values`.
  void hand_over(std::string_view name, FieldValues& values);
  /// Brings the fields of these motions to the first rank, where the snapshots until renew() have
  /// no other fields that change: the rest of the state stays where it is. All ranks must call it.
  void collect(const std::set<Simulation::Motion>& motions);
  /// Throws PluginMistake if there is nothing but collected fields. `what`: is asked for.
  void must_have_state(std::string_view what) const;

 private:
  using Compute = void (SnapshotSource::*)(std::vector<double>& numbers);
  /// Returns the function of a field of field_table; null if laws give the field.
  static Compute function_of(std::string_view name);

  bool field(std::string_view name, Field& out);
  void compute(std::string_view name, FieldValues& values);
  void displacement(std::vector<double>& numbers);
  void velocity(std::vector<double>& numbers);
  void height(std::vector<double>& numbers);
  void material(std::vector<double>& numbers);
  void source(std::vector<double>& numbers);
  void mass(std::vector<double>& numbers);
  void volume(std::vector<double>& numbers);
  void broken_open(std::vector<double>& numbers) { count_broken(numbers, true); }
  void broken_closed(std::vector<double>& numbers) { count_broken(numbers, false); }
  void damage(std::vector<double>& numbers);
  void crack_opening(std::vector<double>& numbers) { simulation_.crack_openings(numbers); }
  void crack_time(std::vector<double>& numbers) { simulation_.crack_times(numbers); }
  void fragment(std::vector<double>& numbers);
  void stress(std::vector<double>& numbers);
  void nominal_stress(std::vector<double>& numbers);
  void principal_stress(std::vector<double>& numbers);
  template <std::size_t n>
  void principal_direction(std::vector<double>& numbers);
  void von_mises(std::vector<double>& numbers);
  void pressure(std::vector<double>& numbers);
  void strain(std::vector<double>& numbers);
  void hencky_strain(std::vector<double>& numbers);
  void strain_rate(std::vector<double>& numbers);
  void energy_density(std::vector<double>& numbers);
  void kinetic_energy_density(std::vector<double>& numbers);
  void internal_force(std::vector<double>& numbers);
  void external_force(std::vector<double>& numbers);
  void force(std::vector<double>& numbers);
  void acceleration(std::vector<double>& numbers);
  Resultant resultant(ForcesId forces, Vec3 about);
  std::span<const double> fragments(double damage);
  std::span<const CrackFace> crack_faces(double damage);
  BodyCubes cubes();
  void count_broken(std::vector<double>& numbers, bool open);

  const Model& model_;
  Simulation& simulation_;
  Snapshot snapshot_;
  std::vector<double> positions_;
  std::map<std::string, FieldValues, std::less<>> fields_;
  bool has_collected_only_ = false;  ///< other fields would need blocks of other ranks
  std::optional<Measured> measured_;
  bool forces_current_ = false;
  /// Springs of each particle at the start; filled when damage is first asked for.
  std::vector<std::uint32_t> springs_of_;
  std::vector<double> masses_;  ///< kg; filled when fragments are first asked for
  std::vector<double> fragments_;
  std::vector<CrackFace> crack_faces_;
  CubeGrid cubes_;  ///< until the state changes; filled when cubes are asked for
};

}  // namespace hyperlattice
