#include <report/viewer_data.hpp>

#include <hyperlattice/field_table.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyperlattice::report {

namespace {

constexpr std::string_view displacement = "displacement";
// A number of 16 bits as base64 text, bytes.
constexpr double text_of_number = 2 * 4.0 / 3;
constexpr auto most_particles =
    static_cast<std::size_t>(static_cast<double>(largest_viewer_data) / (3 * text_of_number));

const VtuField* find(const VtuFrame& frame, std::string_view name) {
  for (const VtuField& field : frame.fields)
    if (field.name == name) return &field;
  return nullptr;
}

/// Returns the places at rest, m; those of the frame itself if it does not tell displacements.
std::vector<double> places_at_rest(const VtuFrame& first, bool is_deformed) {
  std::vector<double> places = first.points;
  const VtuField* moved = find(first, displacement);
  if (is_deformed && moved != nullptr && moved->values.size() == places.size())
    std::transform(places.begin(), places.end(), moved->values.begin(), places.begin(),
                   std::minus<>());
  return places;
}

/// Adds displacements since the first frame to a frame of displaced points that lacks them.
void add_displacement(VtuFrame& frame, const std::vector<double>& rest) {
  VtuField field{std::string(displacement), {"x", "y", "z"}, frame.points};
  std::transform(rest.begin(), rest.end(), field.values.begin(), field.values.begin(),
                 [](double from, double to) { return to - from; });
  frame.fields.push_back(std::move(field));
}

/// Returns the median distance to the nearest neighbour, m, of some particles spread evenly over
/// the list.
double spacing_of(const std::vector<double>& places) {
  constexpr std::size_t most_samples = 100;
  const std::size_t count = places.size() / 3;
  std::vector<double> distances;
  for (const std::size_t p : evenly(count, most_samples)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t q = 0; q < count; ++q) {
      if (q == p) continue;
      double square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double way = places[3 * q + axis] - places[3 * p + axis];
        square += way * way;
      }
      nearest = std::min(nearest, square);
    }
    if (std::isfinite(nearest)) distances.push_back(std::sqrt(nearest));
  }
  if (distances.empty()) return 1;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle > 0 ? *middle : 1;
}

Json described(const VtuFrame& frame) {
  Json fields = Json::array();
  std::size_t first = 0;
  for (const VtuField& field : frame.fields) {
    const FieldInfo* known = find_field(field.name);
    fields.push_back({{"name", field.name},
                      {"unit", known == nullptr ? "" : std::string(known->unit)},
                      {"components", field.components},
                      {"is_vector", field.components == std::vector<std::string>{"x", "y", "z"}},
                      {"first", first}});
    first += field.components.size();
  }
  return fields;
}

/// Returns how many frames fit into the page.
std::size_t most_frames(const RunRecord& run, const VtuFrame& frame) {
  std::size_t arrays = 0;
  for (const VtuField& field : frame.fields) arrays += field.components.size();
  const double array = text_of_number * static_cast<double>(frame.particles);
  const double left = static_cast<double>(largest_viewer_data) - 3 * array;
  const double most = left / (array * static_cast<double>(std::max<std::size_t>(arrays, 1)));
  if (!(most >= 1))
    throw InputError(
        {{"--interactive",
          fmt::format("{}: {} particles with {} numbers", run.folder.string(), frame.particles,
                      arrays),
          fmt::format("frames of at most {:.0f} MB in the page: give the writer fewer fields, or a "
                      "region",
                      static_cast<double>(largest_viewer_data) / 1e6)}});
  constexpr double most_useful = 10000;
  return static_cast<std::size_t>(std::min(most, most_useful));
}

}  // namespace

ViewerData read_viewer_data(const RunRecord& run) {
  const FrameSeries series = find_frames(run);
  VtuFrame first = read_frame(run, series.frames.front(), most_particles);
  const std::vector<double> rest = places_at_rest(first, series.is_deformed);
  const bool lacks_displacement = series.is_deformed && find(first, displacement) == nullptr;
  if (lacks_displacement) add_displacement(first, rest);
  if (first.fields.empty() || first.particles == 0)
    throw InputError({{"--interactive", (run.folder / series.frames.front().name).string(),
                       "frames with particles and a field"}});

  ViewerData data;
  data.about = {{"particles", first.particles},
                {"spacing", spacing_of(rest)},
                {"reference", Json::array()},
                {"fields", described(first)},
                {"frames", Json::array()}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    data.about["reference"].push_back(data.numbers.add(rest, 3, axis));
  const auto chosen = evenly(series.frames.size(), most_frames(run, first));
  for (const std::size_t n : chosen) {
    VtuFrame frame = read_frame(run, series.frames[n], most_particles);
    if (lacks_displacement) add_displacement(frame, rest);
    if (frame.particles != first.particles || described(frame) != data.about["fields"])
      throw InputError({{(run.folder / series.frames[n].name).string(), "",
                         "the particles and fields of the first frame"}});
    Json arrays = Json::array();
    const Json before = data.about["frames"].empty() ? Json() : data.about["frames"].back();
    for (const VtuField& field : frame.fields)
      for (std::size_t part = 0; part < field.components.size(); ++part)
        arrays.push_back(
            data.numbers.add(field.values, field.components.size(), part,
                             before.is_null() ? Json() : before["arrays"][arrays.size()]));
    data.about["frames"].push_back({{"time", series.frames[n].time}, {"arrays", arrays}});
  }
  if (chosen.size() < series.frames.size())
    data.notes.push_back(fmt::format("{} of {} frames, evenly chosen, so that the page is small.",
                                     chosen.size(), series.frames.size()));
  if (lacks_displacement)
    data.notes.push_back("The frames hold no displacements; those shown are since the first.");
  return data;
}

}  // namespace hyperlattice::report
