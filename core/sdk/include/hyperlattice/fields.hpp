// Fields by name, and single numbers taken from them, for writers and probes.
//
//   struct Options : QuantityOptions { ... };
//   static Schema<Options> schema() {
//     ... add_quantity_options(schema); schema.check(check_quantity_options<Options>); ...
//   }
#pragma once

#include <hyperlattice/files.hpp>
#include <hyperlattice/output.hpp>

#include <algorithm>

namespace hyperlattice {

/// Joins names with commas: "displacement, velocity, height".
inline std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

inline bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] inline void refuse_field(std::string_view name,
                                      std::span<const std::string_view> present) {
  throw std::runtime_error("this run has no field \"" + std::string(name) + "\"; it has " +
                           joined(present));
}

/// Tells the run that the frames of a writer will ask for the field `name`. Throws
/// std::runtime_error, with the names of the existing fields, if the run has no such field. For
/// begin(), before anything is computed.
inline void require_field(const OutputContext& context, std::string_view name) {
  if (!context.fields.empty() && !is_one_of(context.fields, name))
    refuse_field(name, context.fields);
  context.use(name);
}

/// Returns the field at this time. Throws like the function above.
inline Field require_field(const Snapshot& snapshot, std::string_view name) {
  Field field;
  if (snapshot.field(name, field)) return field;
  std::vector<std::string_view> present;
  for (const std::string_view candidate : field_names)
    if (Field other; snapshot.field(candidate, other)) present.push_back(candidate);
  refuse_field(name, present);
}

inline Vec3 position_of(const Snapshot& snapshot, Particle particle) {
  const double* x = &snapshot.positions[3 * particle];
  return {x[0], x[1], x[2]};
}

/// Returns whether a field has the same values in all snapshots of a run.
inline bool is_constant_field(std::string_view name) {
  return name == "material" || name == "source";
}

inline bool is_vector_field(std::string_view name) {
  return name == "displacement" || name == "velocity";
}

/// A number taken from a vector; radial: the component along the line from a centre, outwards.
enum class Projection : std::uint32_t { x, y, z, magnitude, radial };
inline constexpr std::string_view projection_names[] = {"x", "y", "z", "magnitude", "radial"};

struct QuantityOptions {
  std::string field;
  std::optional<Projection> component;
  Vec3 centre;
};

/// Declares the options above.
template <class Options>
void add_quantity_options(Schema<Options>& schema) {
  schema.template add<&Options::field>("field", "", "what to record")
      .choices(field_names)
      .fallback("\"displacement\"")
      .template add<&Options::component>("component", "",
                                         "which number of a vector; left out: x, y and z")
      .choices(projection_names)
      .template add<&Options::centre>("centre", "m",
                                      "where the component \"radial\" points away from")
      .fallback("[0, 0, 0]");
}

/// Checks the options above against each other.
template <class Options>
void check_quantity_options(const Options& options, const FaultSink& faults) {
  if (options.component && !is_vector_field(options.field))
    faults.fault("component", "no component, because \"" + options.field + "\" is a single number");
}

/// One or three numbers of a particle: a field, or a component of it.
class Quantity {
 public:
  Quantity() = default;
  explicit Quantity(QuantityOptions options) : options_(std::move(options)) {
    if (!is_vector_field(options_.field))
      names_ = {options_.field};
    else if (options_.component)
      names_ = {options_.field + "_" +
                std::string(projection_names[static_cast<std::size_t>(*options_.component)])};
    else
      names_ = {options_.field + "_x", options_.field + "_y", options_.field + "_z"};
  }

  /// Returns one name for each number: "displacement_x", ...
  const std::vector<std::string>& names() const { return names_; }
  const std::string& field() const { return options_.field; }

  /// Writes the particle's numbers, names().size() of them, to `out`. `field`: the quantity's field
  /// at the snapshot's time.
  void evaluate(const Snapshot& snapshot, const Field& field, Particle particle,
                double* out) const {
    project(&field.values[particle * field.components], position_of(snapshot, particle), out);
  }

  /// Does the same for the field's numbers `value` at a place of the body at rest.
  void project(const double* value, Vec3 place, double* out) const {
    if (!options_.component || !is_vector_field(options_.field)) {
      for (std::size_t n = 0; n < names_.size(); ++n) out[n] = value[n];
      return;
    }
    const Vec3 v{value[0], value[1], value[2]};
    switch (*options_.component) {
      case Projection::magnitude:
        *out = norm(v);
        break;
      case Projection::radial:
        *out = radial(place, v);
        break;
      default:
        *out = value[static_cast<std::size_t>(*options_.component)];
    }
  }

 private:
  double radial(Vec3 place, Vec3 value) const {
    const Vec3 outwards = place - options_.centre;
    const double distance = norm(outwards);
    return distance > 0 ? dot(value, outwards) / distance : 0;
  }

  QuantityOptions options_;
  std::vector<std::string> names_;
};

/// Returns the particle whose position at rest is nearest to the point; the first if there are
/// several.
inline Particle nearest_particle(const Snapshot& snapshot, Vec3 point) {
  Particle best = 0;
  double least = infinity;
  for (Particle particle = 0; particle < snapshot.particles; ++particle) {
    const Vec3 apart = position_of(snapshot, particle) - point;
    const double square = dot(apart, apart);
    if (square < least) {
      least = square;
      best = particle;
    }
  }
  return best;
}

/// Returns a place as text for a column name: "(0.01 0 0)". No commas, so that any reader of tables
/// can split the header.
inline std::string place_text(Vec3 place) {
  return "(" + short_number(place.x) + " " + short_number(place.y) + " " + short_number(place.z) +
         ")";
}

}  // namespace hyperlattice
