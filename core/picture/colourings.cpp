#include <picture/colourings.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>

namespace hyperlattice::picture {

namespace {

struct Colourings {
  Colourings() {
    std::size_t next = 0;
    names[next++] = failure;
    for (const FieldInfo& field : field_table) {
      if (has_one_colour(field)) names[next++] = field.name;
      if (field.kind != FieldKind::number)
        for (const std::string_view part : parts_of(field.kind))
          names[next++] = texts.emplace_back(std::string(field.name) + "_" + std::string(part));
    }
  }
  std::deque<std::string> texts;
  ColouringNames names;
};

using Sample = std::array<double, 3>;  ///< red, green, blue, 0 to 1

constexpr Sample viridis_samples[] = {{.267, .005, .329}, {.283, .141, .458}, {.254, .265, .530},
                                      {.207, .372, .553}, {.164, .471, .558}, {.128, .567, .551},
                                      {.135, .659, .518}, {.267, .749, .441}, {.478, .821, .318},
                                      {.741, .873, .150}, {.993, .906, .144}};
constexpr Sample cividis_samples[] = {{.000, .133, .306}, {.071, .208, .439}, {.231, .286, .424},
                                      {.341, .365, .427}, {.439, .443, .451}, {.541, .525, .471},
                                      {.647, .612, .455}, {.765, .702, .412}, {.882, .800, .333},
                                      {.996, .910, .220}};
constexpr Sample inferno_samples[] = {{.000, .000, .016}, {.106, .047, .255}, {.290, .047, .420},
                                      {.471, .110, .427}, {.647, .173, .376}, {.812, .267, .275},
                                      {.929, .412, .145}, {.984, .608, .024}, {.969, .820, .239},
                                      {.988, 1.00, .643}};
constexpr Sample blue_red_samples[] = {{.020, .188, .380}, {.129, .400, .675}, {.263, .576, .765},
                                       {.573, .773, .871}, {.820, .898, .941}, {.969, .969, .969},
                                       {.992, .859, .780}, {.957, .647, .510}, {.839, .376, .302},
                                       {.698, .094, .169}, {.404, .000, .122}};
constexpr Sample grey_samples[] = {{.15, .15, .15}, {.92, .92, .92}};

std::span<const Sample> samples_of(ColourMap map) {
  switch (map) {
    case ColourMap::cividis:
      return cividis_samples;
    case ColourMap::inferno:
      return inferno_samples;
    case ColourMap::blue_red:
      return blue_red_samples;
    case ColourMap::grey:
      return grey_samples;
    default:
      return viridis_samples;
  }
}

}  // namespace

const ColouringNames& colourings() {
  static const Colourings all;
  return all.names;
}

std::string usual_colouring(std::span<const std::string_view> fields) {
  return std::string(is_one_of(fields, "broken_open") ? failure : "displacement");
}

QuantityOptions quantity_of(std::string_view colouring) {
  const FieldPart of = find_field_part(colouring);
  if (of.field == nullptr) return {std::string(colouring), std::nullopt, {}};
  const std::string field(of.field->name);
  if (of.part.empty())
    return {
        field,
        of.field->kind == FieldKind::vector ? std::optional(Projection::magnitude) : std::nullopt,
        {}};
  const auto* const found =
      std::find(std::begin(projection_names), std::end(projection_names), of.part);
  return {field, static_cast<Projection>(found - std::begin(projection_names)), {}};
}

NumberRange range_of(std::span<const double> values) {
  NumberRange range{infinity, -infinity};
  for (const double value : values)
    if (std::isfinite(value)) {  // a particle may have no value
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  return range.low <= range.high ? range : NumberRange{};
}

void check_range(const std::optional<std::vector<double>>& range, const FaultSink& faults) {
  if (range && !(range->size() == 2 && range->front() < range->back()))
    faults.fault("range", "two numbers, the smaller first");
}

Colour colour_of(ColourMap map, double share) {
  const std::span<const Sample> samples = samples_of(map);
  const auto last = static_cast<double>(samples.size() - 1);
  const double place = last * std::clamp(share, 0.0, 1.0);
  const auto below = static_cast<std::size_t>(std::min(place, last - 1));
  Colour colour{};
  for (std::size_t n = 0; n < 3; ++n)
    colour[n] = static_cast<std::uint8_t>(
        std::lround(255 * std::lerp(samples[below][n], samples[below + 1][n],
                                    place - static_cast<double>(below))));
  return colour;
}

}  // namespace hyperlattice::picture
