// Tables: any table of text, a load's table of time (columns times, values), and the files of
// lattices.points. A form feed separates the points from the springs.
#include "../../lattices/points/points.cpp"

#include "target.hpp"

#include <base/csv.hpp>

#include <hyperlattice/time_function.hpp>

namespace {

void read_load(const CsvTable& table) {
  const auto times = table.column("times"), values = table.column("values");
  if (!times || !values) return;
  TimeOptions options;
  options.form = TimeForm::table;
  for (const auto& row : table.rows)
    if (const auto time = csv_number(row[*times]), value = csv_number(row[*values]);
        time && value) {
      options.times.push_back(*time);
      options.values.push_back(*value);
    }
  bool is_sound = true;
  check_time_options(
      options, FaultSink{&is_sound, [](void* self, std::string_view, std::string_view) noexcept {
                           *static_cast<bool*>(self) = false;
                         }});
  if (!is_sound) return;
  const TimeFunction function(options);
  for (const double time : {0.0, 1e-6, 1.0, 1e300}) function(time);
}

void build(const std::string& points, const std::optional<std::string>& springs) {
  Points::Options options;
  options.points = points;
  options.springs = springs;
  if (!springs) options.coordination = 4;
  LatticeSink sink;
  sink.receive_points = [](void*, const PointList& list) noexcept {
    for (const ListedSpring& spring : list.springs)
      fuzz::require(spring.a < list.positions.size() && spring.b < list.positions.size());
  };
  fuzz::read_or_refuse<std::invalid_argument>([&] { Points(options).build(sink); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  std::string_view springs;
  const std::string_view points = fuzz::first_file(fuzz::text_of(data, size), springs);
  const CsvTable table = parse_csv(points);
  for (const auto& row : table.rows) fuzz::require(row.size() == table.columns.size());
  name_of_several(table);
  read_load(table);
  const std::string file = folder.write("points.csv", points);
  build(file, std::nullopt);
  if (!springs.empty()) build(file, folder.write("springs.csv", springs));
  return 0;
}
