// The fields that a run can have: one table, which options of writers and probes, files, pages and
// the core read.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>

namespace hyperlattice {

/// Number, vector in space, symmetric tensor, tensor, or three numbers in descending order.
enum class FieldKind : std::uint32_t { number, vector, symmetric, tensor, sorted };
/// What a body must have so that a field exists in its run.
enum class FieldNeeds : std::uint32_t { nothing, free_membrane, list, failure, damage };

/// What the program says about a field of results.
struct FieldInfo {
  std::string_view name;
  FieldKind kind = FieldKind::number;
  std::string_view unit;  ///< SI; empty: a count, an index or a ratio
  std::string_view help;
  FieldNeeds needs = FieldNeeds::nothing;
  bool is_measured = false;  ///< whether it is computed from all springs or all loads of the body
};

inline constexpr FieldInfo field_table[] = {
    {"displacement", FieldKind::vector, "m", "present place less undeformed place"},
    {"velocity", FieldKind::vector, "m/s", "velocity half a step before the time"},
    {"height", FieldKind::number, "m", "displacement in the fourth dimension",
     FieldNeeds::free_membrane},
    {"material", FieldKind::number, "", "index of the material in the scene, from 0"},
    {"source", FieldKind::number, "", "index of the particle in the list's own order, from 0",
     FieldNeeds::list},
    {"mass", FieldKind::number, "kg", "mass of the particle"},
    {"volume", FieldKind::number, "m3", "undeformed volume of the particle"},
    {"broken_open", FieldKind::number, "",
     "number of the particle's broken springs that are longer than undeformed",
     FieldNeeds::failure},
    {"broken_closed", FieldKind::number, "", "number of the others that are broken",
     FieldNeeds::failure},
    {"damage", FieldKind::number, "",
     "mean of 1 - integrity over the particle's springs; of cohesive materials the state d between "
     "0, whole, and 1, without tension",
     FieldNeeds::failure},
    {"crack_opening", FieldKind::number, "m",
     "opening of a crack in the particle's layer, one spacing thick; the openings along a lattice "
     "row that is normal to a crack add up to the crack's",
     FieldNeeds::damage},
    {"crack_time", FieldKind::number, "s",
     "time at which the damage of the particle reached 0.9; not a number: it has not",
     FieldNeeds::damage},
    {"fragment", FieldKind::number, "",
     "number of the connected piece, 0 for the heaviest; of equal ones the piece with the first "
     "particle is first",
     FieldNeeds::nothing, true},
    {"stress", FieldKind::symmetric, "Pa", "Cauchy stress", FieldNeeds::nothing, true},
    {"nominal_stress", FieldKind::tensor, "Pa",
     "first Piola-Kirchhoff stress: component xy is the force along x on an undeformed area "
     "normal to y",
     FieldNeeds::nothing, true},
    {"principal_stress", FieldKind::sorted, "Pa", "eigenvalues of the Cauchy stress",
     FieldNeeds::nothing, true},
    {"principal_direction_1", FieldKind::vector, "", "direction of the largest principal stress",
     FieldNeeds::nothing, true},
    {"principal_direction_2", FieldKind::vector, "", "direction of the middle principal stress",
     FieldNeeds::nothing, true},
    {"principal_direction_3", FieldKind::vector, "", "direction of the least principal stress",
     FieldNeeds::nothing, true},
    {"von_mises", FieldKind::number, "Pa", "von Mises stress", FieldNeeds::nothing, true},
    {"pressure", FieldKind::number, "Pa", "mean pressure, minus a third of the trace of stress",
     FieldNeeds::nothing, true},
    {"strain", FieldKind::symmetric, "", "Green-Lagrange strain (F^T F - I) / 2",
     FieldNeeds::nothing, true},
    {"hencky_strain", FieldKind::symmetric, "", "logarithmic strain ln(F^T F) / 2",
     FieldNeeds::nothing, true},
    {"strain_rate", FieldKind::symmetric, "1/s", "symmetric part of the velocity gradient in space",
     FieldNeeds::nothing, true},
    {"energy_density", FieldKind::number, "J/m3", "stored energy per undeformed volume",
     FieldNeeds::nothing, true},
    {"kinetic_energy_density", FieldKind::number, "J/m3", "kinetic energy per undeformed volume",
     FieldNeeds::nothing, true},
    {"internal_force", FieldKind::vector, "N", "force of the springs on the particle",
     FieldNeeds::nothing, true},
    {"external_force", FieldKind::vector, "N",
     "force of the loads; along prescribed axes the force that keeps the motion",
     FieldNeeds::nothing, true},
    {"force", FieldKind::vector, "N", "internal and external force, without damping",
     FieldNeeds::nothing, true},
    {"acceleration", FieldKind::vector, "m/s2",
     "internal and external force over mass, without damping", FieldNeeds::nothing, true},
};

namespace detail {

struct FieldNames {
  std::string_view of[std::size(field_table)];
};
constexpr FieldNames names_of_fields() {
  FieldNames names;
  for (std::size_t n = 0; n < std::size(field_table); ++n) names.of[n] = field_table[n].name;
  return names;
}
inline constexpr FieldNames all_names = names_of_fields();

inline constexpr std::string_view no_parts[] = {""};
inline constexpr std::string_view vector_parts[] = {"x", "y", "z"};
inline constexpr std::string_view symmetric_parts[] = {"xx", "yy", "zz", "yz", "xz", "xy"};
inline constexpr std::string_view tensor_parts[] = {"xx", "xy", "xz", "yx", "yy",
                                                    "yz", "zx", "zy", "zz"};
inline constexpr std::string_view sorted_parts[] = {"1", "2", "3"};

}  // namespace detail

/// The names, for options that list fields.
inline constexpr auto& field_names = detail::all_names.of;

/// Most components of a field.
inline constexpr std::size_t max_field_components = 9;

/// Returns the names of the components, in their order; one empty name of a number. Symmetric
/// tensors have the order of Voigt.
constexpr std::span<const std::string_view> parts_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::vector:
      return detail::vector_parts;
    case FieldKind::symmetric:
      return detail::symmetric_parts;
    case FieldKind::tensor:
      return detail::tensor_parts;
    case FieldKind::sorted:
      return detail::sorted_parts;
    default:
      return detail::no_parts;
  }
}
constexpr std::uint32_t components_of(const FieldInfo& field) {
  return static_cast<std::uint32_t>(parts_of(field.kind).size());
}

/// Returns the field of this name; null if there is none.
constexpr const FieldInfo* find_field(std::string_view name) {
  for (const FieldInfo& field : field_table)
    if (field.name == name) return &field;
  return nullptr;
}

/// A field, or one component of it, as an option of a scene may name it: "velocity", "velocity_x".
struct FieldPart {
  const FieldInfo* field = nullptr;  ///< null: no field has this name
  std::string_view part;             ///< empty: the whole field
};
constexpr FieldPart find_field_part(std::string_view name) {
  if (const FieldInfo* field = find_field(name)) return {field, {}};
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos) return {};
  const FieldInfo* field = find_field(name.substr(0, bar));
  if (field == nullptr || field->kind == FieldKind::number) return {};
  for (const std::string_view part : parts_of(field->kind))
    if (part == name.substr(bar + 1)) return {field, part};
  return {};
}

}  // namespace hyperlattice
