// What the colours of a picture show: the state of failure, a field, or a component of one.
#pragma once

#include <picture/palette.hpp>

#include <hyperlattice/fields.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::picture {

/// The name of the colouring by the state of failure.
inline constexpr std::string_view failure = "failure";

constexpr bool has_one_colour(const FieldInfo& field) {
  return field.kind == FieldKind::number || field.kind == FieldKind::vector;
}
constexpr std::size_t count_of_colourings() {
  std::size_t all = 1;
  for (const FieldInfo& field : field_table) {
    if (has_one_colour(field)) ++all;
    if (field.kind != FieldKind::number) all += components_of(field);
  }
  return all;
}
using ColouringNames = std::string_view[count_of_colourings()];

/// Returns "failure", all fields that have a number or a magnitude, and all components:
/// "stress_xx".
const ColouringNames& colourings();

/// Returns the colouring of pictures that name none: by failure if the run's springs can break,
/// else by displacement.
std::string usual_colouring(std::span<const std::string_view> fields);

/// Returns the quantity of a colouring: "displacement_y" is the component y of the field
/// displacement, "displacement" its magnitude.
QuantityOptions quantity_of(std::string_view colouring);

/// The least and the greatest number of a list; 0 and 0 if it has none that is finite.
struct NumberRange {
  double low = 0, high = 0;
};
NumberRange range_of(std::span<const double> values);

/// Checks the option "range": two numbers, if there are any.
void check_range(const std::optional<std::vector<double>>& range, const FaultSink& faults);

/// Returns the place of a value in a range, for a colour map: 0 for all values if the range is a
/// point.
inline double share_of(double value, NumberRange range) {
  return range.high > range.low ? (value - range.low) / (range.high - range.low) : 0;
}

}  // namespace hyperlattice::picture
