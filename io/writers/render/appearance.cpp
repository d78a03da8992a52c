#include "appearance.hpp"

#include "prefixes.hpp"

#include <algorithm>
#include <cmath>

namespace hyperlattice::render {

namespace {

// Okabe and Ito, Color Universal Design (2008): sky blue, vermilion, bluish green.
constexpr Colour safe_intact{86, 180, 233}, safe_open{213, 94, 0}, safe_closed{0, 158, 115};

Appearance by_failure(const Snapshot& snapshot, const Options& options) {
  const auto open = require_field(snapshot, "broken_open").values,
             closed = require_field(snapshot, "broken_closed").values;
  const Colour intact =
      options.failure_colours == FailureColours::paper ? picture::intact : safe_intact;
  Appearance appearance;
  for (Particle particle = 0; particle < snapshot.particles; ++particle)
    appearance.particles.push_back(open[particle] > 0     ? open_colour(options)
                                   : closed[particle] > 0 ? closed_colour(options)
                                                          : intact);
  appearance.keys = {{intact, "intact"},
                     {open_colour(options), "open failure"},
                     {closed_colour(options), "closed failure"}};
  return appearance;
}

Appearance by_quantity(const Snapshot& snapshot, const Options& options, std::string_view colour_by,
                       const std::vector<bool>& is_drawn) {
  const Quantity quantity(picture::quantity_of(colour_by));
  const Field field = require_field(snapshot, quantity.field());
  std::vector<double> values(snapshot.particles), drawn;
  for (Particle particle = 0; particle < snapshot.particles; ++particle) {
    quantity.evaluate(snapshot, field, particle, &values[particle]);
    if (is_drawn[particle]) drawn.push_back(values[particle]);
  }
  Scale scale;
  scale.map = options.colour_map;
  scale.range = options.range ? picture::NumberRange{options.range->front(), options.range->back()}
                              : picture::range_of(drawn);
  scale.name = quantity.names().front();
  std::replace(scale.name.begin(), scale.name.end(), '_', ' ');
  if (const FieldInfo* info = find_field(quantity.field());
      info != nullptr && !info->unit.empty()) {
    const PrefixedUnit unit =
        prefixed(info->unit, std::max(std::abs(scale.range.low), std::abs(scale.range.high)));
    scale.factor = unit.factor;
    scale.unit = "(" + unit.unit + ")";
  }
  Appearance appearance;
  for (const double value : values)
    appearance.particles.push_back(
        std::isfinite(value) ? picture::colour_of(scale.map, picture::share_of(value, scale.range))
                             : picture::no_value);
  if (!std::all_of(drawn.begin(), drawn.end(), [](double value) { return std::isfinite(value); }))
    appearance.keys.push_back({picture::no_value, "no value"});
  appearance.scale = std::move(scale);
  return appearance;
}

}  // namespace

Colour open_colour(const Options& options) {
  return options.failure_colours == FailureColours::paper ? picture::open_failure : safe_open;
}

Colour closed_colour(const Options& options) {
  return options.failure_colours == FailureColours::paper ? picture::closed_failure : safe_closed;
}

Appearance appearance_of(const Snapshot& snapshot, const Options& options,
                         std::string_view colour_by, const std::vector<bool>& is_drawn) {
  Appearance appearance = colour_by == picture::failure
                              ? by_failure(snapshot, options)
                              : by_quantity(snapshot, options, colour_by, is_drawn);
  if (options.cracks) appearance.keys.push_back({crack_colour, "crack"});
  if (options.springs && colour_by != picture::failure)
    for (const auto& [colour, text] : {std::pair(open_colour(options), "broken, open"),
                                       std::pair(closed_colour(options), "broken, closed")})
      appearance.keys.push_back({colour, text});
  return appearance;
}

}  // namespace hyperlattice::render
