#include <quantities/units.hpp>
#include <scene/expectation.hpp>
#include <study/comparison.hpp>

#include <hyperlattice/tables.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice::study {

namespace {

struct ComparisonEntry {
  struct Options {
    std::optional<std::string> probe;
    std::string column;
    std::optional<Coordinate> along;
    Reduction reduce = Reduction::none;
    std::optional<std::string> truth, over;
    std::optional<double> over_scale;
    double scale = 1;
  };
  static Schema<Options> schema() {
    return Schema<Options>("", "")
        .add<&Options::probe>(
            "probe", "",
            "name of a probe of the scene; left out: history.csv, the energies of the run")
        .add<&Options::column>("column", "",
                               "of its table; what stands from \"@\" on may be left out")
        .add<&Options::along>(
            "along", "", "compare at the last time, over this coordinate of the columns' places")
        .choices(coordinate_names)
        .add<&Options::reduce>("reduce", "", "compare one number in place of all points")
        .choices(reduction_names)
        .fallback("\"none\"")
        .add<&Options::truth>("truth", "", "the truth's column, or its number's name")
        .add<&Options::over>("over", "", "the truth's column of time or place")
        .add<&Options::over_scale>(
            "over_scale", "", "what stands there, times this, is the run's time or place in SI")
        .positive()
        .add<&Options::scale>("scale", "", "the truth times this is in SI")
        .fallback("1");
  }
};

/// Reads a place: a number in m, a text with a unit, or the name of a column.
void read_place(const Json& given, Comparison& comparison, Faults& faults) {
  if (given.is_number())
    comparison.at = given.get<double>();
  else if (!given.is_string())
    faults.add(comparison.pointer + "/at", shown(given),
               "a length such as \"1 mm\", or a column of the probe such as \"radius\"");
  else if (const Quantity place = read_quantity(given.get_ref<const std::string&>(), "m");
           place.problem.empty())
    comparison.at = place.value;
  else
    comparison.at_column = given.get<std::string>();
}

void require_column(const CsvTable& table, const std::string& file, const std::string& name,
                    const std::string& pointer, Faults& faults) {
  if (!table.column(name))
    faults.add(pointer, shown(name),
               fmt::format("a column of {}: {}", file, fmt::join(table.columns, ", ")) +
                   did_you_mean(name, table.columns));
  else if (std::find(table.columns.begin(), table.columns.end(), name) == table.columns.end() &&
           is_ambiguous_column(table.columns, name))
    faults.add(
        pointer, shown(name),
        fmt::format("one column of {}, and several differ from it in capital letters only", file));
}

void check_filters(const std::vector<RowFilter>& filters, const std::string& pointer,
                   const Truth& truth, Faults& faults) {
  for (const RowFilter& filter : filters)
    require_column(*truth.table, truth.file.filename().string(), filter.column,
                   member(pointer, filter.column), faults);
}

void check_table(const Comparison& comparison, const Truth& truth, Faults& faults) {
  const std::string file = truth.file.filename().string();
  const CsvTable& table = *truth.table;
  if (comparison.has_place() && placed_columns(table, comparison.truth).empty())
    faults.add(comparison.pointer + "/truth", shown(comparison.truth),
               fmt::format("columns {0}@<place in metres> of {1}, because of \"at\"; it has {2}",
                           comparison.truth, file, fmt::join(table.columns, ", ")));
  if (!comparison.has_place())
    require_column(table, file, comparison.truth, comparison.pointer + "/truth", faults);
  const std::string over = over_column(comparison, truth);
  require_column(table, file, over,
                 (comparison.over ? comparison.pointer
                  : truth.over    ? truth.pointer
                                  : comparison.pointer) +
                     "/over",
                 faults);
  check_filters(comparison.where, comparison.pointer + "/where", truth, faults);
}

void check(const Comparison& comparison, bool names_truth, const Truth& truth, Faults& faults) {
  if (truth.kind == Truth::Kind::finest) {
    if (names_truth)
      faults.add(comparison.pointer + "/truth", shown(comparison.truth),
                 "no truth's name, because the truth is the finest run");
    return;
  }
  if (!names_truth && !(truth.kind == Truth::Kind::numbers && truth.numbers.count("") != 0))
    return faults.add(comparison.pointer + "/truth", "",
                      "the truth's column or the name of its number (it is required, but missing)");
  if (truth.kind == Truth::Kind::table && truth.table) check_table(comparison, truth, faults);
  if (truth.kind != Truth::Kind::numbers) return;
  if (comparison.along && comparison.reduction == Reduction::none)
    faults.add(comparison.pointer + "/along", "",
               "\"reduce\" with it, because the truth is a number");
  if (truth.numbers.empty() || truth.numbers.count(comparison.truth) != 0) return;
  std::vector<std::string> names;
  for (const auto& [name, number] : truth.numbers)
    if (!name.empty()) names.push_back(name);
  faults.add(comparison.pointer + "/truth", shown(comparison.truth),
             names.empty() ? "no name, because the truth is a single number"
                           : fmt::format("a number of the truth: {}", fmt::join(names, ", ")) +
                                 did_you_mean(comparison.truth, names));
}

constexpr const char* needless = "nothing here, because the study has no truth";

/// Adds faults for keys that are used only if the truth is a table.
void check_table_keys(const Json& given, const Comparison& comparison,
                      const std::vector<Truth>& truths, Faults& faults) {
  if (std::any_of(truths.begin(), truths.end(),
                  [](const Truth& truth) { return truth.kind == Truth::Kind::table; }))
    return;
  for (const char* key : {"at", "where", "over", "over_scale"})
    if (given.contains(key))
      faults.add(member(comparison.pointer, key), shown(given[key]),
                 truths.empty() ? needless : "nothing here, because the truth is no table");
}

/// Adds faults for what a quantity of a study without a truth cannot have.
void check_value(const Json& given, const Comparison& comparison, Faults& faults) {
  for (const char* key : {"truth", "scale"})
    if (given.contains(key))
      faults.add(member(comparison.pointer, key), shown(given[key]), needless);
  if (comparison.along && comparison.reduction == Reduction::none)
    faults.add(comparison.pointer + "/along", "",
               "\"reduce\" with it, because a study without a truth shows one number");
}

}  // namespace

std::string over_column(const Comparison& comparison, const Truth& truth) {
  if (comparison.over) return *comparison.over;
  if (truth.over) return *truth.over;
  if (comparison.along)
    return std::string(coordinate_names[static_cast<std::size_t>(*comparison.along)]);
  return truth.table->column("t") ? "t" : "time";
}

std::vector<std::pair<double, std::size_t>> placed_columns(const CsvTable& table,
                                                           const std::string& name) {
  std::vector<std::pair<double, std::size_t>> placed;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].starts_with(name + "@"))
      if (const auto place = csv_number(std::string_view(table.columns[c]).substr(name.size() + 1)))
        placed.emplace_back(*place, c);
  std::sort(placed.begin(), placed.end());
  return placed;
}

std::vector<Comparison> read_comparisons(const Json& given, const std::vector<Truth>& truths,
                                         const std::vector<Axis>& axes, ObjectReader& reader) {
  Faults& faults = reader.faults();
  std::vector<Comparison> comparisons;
  if (!given.is_object() || given.empty()) {
    faults.add("/compare", shown(given),
               "an object of names, each with what is compared: {\"probe\": name, \"column\": "
               "name, \"truth\": name, ...}");
    return comparisons;
  }
  for (const auto& item : given.items()) {
    Comparison comparison;
    comparison.name = item.key();
    comparison.pointer = member("/compare", item.key());
    if (item.key().empty() || item.key().find_first_of(",\n") != std::string::npos)
      faults.add(comparison.pointer, shown(item.key()), "a name without commas");
    if (item.value().is_object() && item.value().contains("at"))
      read_place(item.value()["at"], comparison, faults);
    if (item.value().is_object() && item.value().contains("where"))
      comparison.where =
          read_filters(item.value()["where"], comparison.pointer + "/where", axes, reader);
    const auto options =
        reader.read<ComparisonEntry>(item.value(), comparison.pointer, {"at", "where"});
    if (!options) continue;
    comparison.probe = options->probe.value_or("");
    comparison.column = options->column;
    comparison.along = options->along;
    comparison.reduction = options->reduce;
    comparison.truth = options->truth.value_or("");
    comparison.over = options->over;
    comparison.over_scale = options->over_scale;
    comparison.scale = options->scale;
    check_table_keys(item.value(), comparison, truths, faults);
    if (truths.empty()) check_value(item.value(), comparison, faults);
    for (const Truth& truth : truths) check(comparison, options->truth.has_value(), truth, faults);
    comparisons.push_back(std::move(comparison));
  }
  for (const Truth& truth : truths)
    if (truth.table) check_filters(truth.where, truth.pointer + "/where", truth, faults);
  return comparisons;
}

}  // namespace hyperlattice::study
