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
#include <array>

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

/// Throws like the functions above. Asks the snapshot only if the run does not name its fields: the
/// snapshot computes what it is asked for.
inline void require_field(const OutputContext& context, const Snapshot& first,
                          std::string_view name) {
  if (context.fields.empty())
    require_field(first, name);
  else
    require_field(context, name);
}

/// Returns whether a field has the same values in all snapshots of a run.
inline bool is_constant_field(std::string_view name) {
  return is_one_of(std::array<std::string_view, 4>{"material", "source", "mass", "volume"}, name);
}

/// A number taken from a field: a component; the magnitude of a vector; radial: along the line from
/// a centre, outwards, v . n of a vector and n . T n of a tensor.
enum class Projection : std::uint32_t {
  x,
  y,
  z,
  magnitude,
  radial,
  xx,
  yy,
  zz,
  xy,
  yz,
  xz,
  yx,
  zy,
  zx,
  first,
  second,
  third
};
inline constexpr std::string_view projection_names[] = {
    "x",  "y",  "z",  "magnitude", "radial", "xx", "yy", "zz", "xy",
    "yz", "xz", "yx", "zy",        "zx",     "1",  "2",  "3"};
constexpr std::string_view name_of(Projection projection) {
  return projection_names[static_cast<std::size_t>(projection)];
}

/// Returns what the option "component" may be for fields of a kind.
inline std::vector<std::string_view> projections_of(FieldKind kind) {
  if (kind == FieldKind::number) return {};
  const auto parts = parts_of(kind);
  std::vector<std::string_view> names(parts.begin(), parts.end());
  if (kind == FieldKind::vector) names.push_back(name_of(Projection::magnitude));
  if (kind != FieldKind::sorted) names.push_back(name_of(Projection::radial));
  return names;
}

/// Options that name one number of a field: the field, its component, and the centre of radii, m.
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
      .plugin_fields()
      .fallback("\"displacement\"")
      .template add<&Options::component>(
          "component", "", "which number of a vector or tensor; left out: all components")
      .choices(projection_names)
      .template add<&Options::centre>("centre", "m",
                                      "where the component \"radial\" points away from")
      .fallback("[0, 0, 0]");
}

/// Checks the options above against each other.
template <class Options>
void check_quantity_options(const Options& options, const FaultSink& faults) {
  const FieldInfo* field = find_field(options.field);
  if (!options.component) return;
  const std::vector<std::string_view> allowed =
      projections_of(field == nullptr ? FieldKind::number : field->kind);
  if (allowed.empty())
    faults.fault("component", "no component, because \"" + options.field + "\" is a single number");
  else if (!is_one_of(allowed, name_of(*options.component)))
    faults.fault("component", "a component of \"" + options.field + "\": " + joined(allowed));
}

/// The numbers of a particle that a probe or a picture shows: a field, or one number taken from it.
class Quantity {
 public:
  Quantity() = default;
  explicit Quantity(QuantityOptions options) : options_(std::move(options)) {
    if (const FieldInfo* field = find_field(options_.field)) kind_ = field->kind;
    const auto parts = parts_of(kind_);
    if (options_.component)
      names_ = {options_.field + "_" + std::string(name_of(*options_.component))};
    else if (kind_ == FieldKind::number)
      names_ = {options_.field};
    else
      for (const std::string_view part : parts)
        names_.push_back(options_.field + "_" + std::string(part));
    if (options_.component)
      part_ = static_cast<std::size_t>(
          std::find(parts.begin(), parts.end(), name_of(*options_.component)) - parts.begin());
  }

  /// Returns one name for each number: "displacement_x", ...; at most max_field_components.
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
    if (!options_.component)
      std::copy_n(value, names_.size(), out);
    else if (*options_.component == Projection::magnitude)
      *out = norm({value[0], value[1], value[2]});
    else if (*options_.component == Projection::radial)
      *out = radial(place, value);
    else
      *out = value[part_];
  }

 private:
  double radial(Vec3 place, const double* v) const {
    const Vec3 outwards = place - options_.centre;
    const double distance = norm(outwards);
    if (!(distance > 0)) return 0;
    if (kind_ == FieldKind::vector) return dot({v[0], v[1], v[2]}, outwards) / distance;
    const Vec3 n = (1 / distance) * outwards;
    if (kind_ == FieldKind::symmetric)
      return dot(n, {v[0] * n.x + v[5] * n.y + v[4] * n.z, v[5] * n.x + v[1] * n.y + v[3] * n.z,
                     v[4] * n.x + v[3] * n.y + v[2] * n.z});
    return dot(
        n, {dot({v[0], v[1], v[2]}, n), dot({v[3], v[4], v[5]}, n), dot({v[6], v[7], v[8]}, n)});
  }

  QuantityOptions options_;
  FieldKind kind_ = FieldKind::number;
  std::size_t part_ = 0;  ///< place of the component in the field
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
