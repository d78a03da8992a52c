#include <scene/expectation.hpp>
#include <study/outside_table.hpp>
#include <study/truth.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::study {

namespace {

struct TableTruth {
  struct Options {
    std::string csv;
    std::optional<std::string> over;
    double over_scale = 1;
  };
  static Schema<Options> schema() {
    return Schema<Options>("", "")
        .add<&Options::csv>("csv", "",
                            "a table, its columns named in the first line; relative to the study")
        .add<&Options::over>("over", "", "the column of time or place")
        .add<&Options::over_scale>(
            "over_scale", "", "what stands there, times this, is the run's time or place in SI")
        .positive()
        .fallback("1");
  }
};

struct FinestTruth {
  struct Options {
    std::optional<double> order;
  };
  static Schema<Options> schema() {
    return Schema<Options>("", "")
        .add<&Options::order>("order", "", "the order of convergence; the observed one if left out")
        .positive();
  }
};

struct AxisValue {
  struct Options {
    std::string axis;
    double scale = 1;
  };
  static Schema<Options> schema() {
    return Schema<Options>("", "")
        .add<&Options::axis>("axis", "", "the axis whose value is meant")
        .add<&Options::scale>("scale", "", "the value, in SI, times this stands in the column")
        .fallback("1");
  }
};

constexpr const char* kinds[] = {"csv", "value", "values", "finest"};
constexpr const char* kinds_text =
    "one of \"csv\", a table; \"value\" or \"values\", numbers; \"finest\", the finest run "
    "extrapolated";

std::optional<double> read_plain_number(const Json& given, const std::string& pointer,
                                        Faults& faults) {
  if (given.is_number() && std::isfinite(given.get<double>())) return given.get<double>();
  faults.add(pointer, shown(given), "a number in SI");
  return std::nullopt;
}

void read_table(Truth& truth, const Json& given, const std::filesystem::path& folder,
                const std::vector<Axis>& axes, ObjectReader& reader) {
  truth.kind = Truth::Kind::table;
  if (given.contains("where"))
    truth.where = read_filters(given["where"], truth.pointer + "/where", axes, reader);
  const auto options = reader.read<TableTruth>(given, truth.pointer, {"when", "where"});
  if (!options) return;
  truth.file = folder / options->csv;
  truth.over = options->over;
  truth.over_scale = options->over_scale;
  const std::size_t before = reader.faults().size();
  try {
    auto table = std::make_shared<CsvTable>(
        read_outside_table(truth.file, truth.pointer + "/csv", "a table", reader.faults()));
    if (table->columns.empty() && reader.faults().size() > before) return;  // not readable
    if (table->rows.empty() && reader.faults().size() == before)
      reader.faults().add(truth.pointer + "/csv", shown(options->csv),
                          "a table with at least one row below the columns' names");
    truth.table = std::move(table);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      reader.faults().add(fault.pointer, fault.value, fault.expected);
  }
}

void read_numbers(Truth& truth, const Json& given, ObjectReader& reader) {
  truth.kind = Truth::Kind::numbers;
  if (given.contains("value")) {
    truth.numbers[""] =
        read_plain_number(given["value"], truth.pointer + "/value", reader.faults()).value_or(0);
    return;
  }
  const Json& values = given["values"];
  if (!values.is_object() || values.empty())
    return reader.faults().add(truth.pointer + "/values", shown(values),
                               "an object of names with numbers in SI");
  for (const auto& item : values.items())
    truth.numbers[item.key()] =
        read_plain_number(item.value(), member(truth.pointer + "/values", item.key()),
                          reader.faults())
            .value_or(0);
}

void reject_others(const Json& given, const Truth& truth, const std::string& kind, Faults& faults) {
  const std::vector<std::string> known{"when", kind};
  for (const auto& item : given.items())
    if (std::find(known.begin(), known.end(), item.key()) == known.end())
      faults.add(member(truth.pointer, item.key()), shown(item.value()),
                 fmt::format("no key beside \"{}\" but \"when\"", kind));
}

Truth read_truth(const Json& given, const std::string& pointer, const std::filesystem::path& folder,
                 const std::vector<Axis>& axes, ObjectReader& reader) {
  Faults& faults = reader.faults();
  Truth truth;
  truth.pointer = pointer;
  if (given.is_string() && given == "finest") {
    truth.kind = Truth::Kind::finest;
    return truth;
  }
  if (!given.is_object()) {
    faults.add(pointer, shown(given),
               std::string("an object with ") + kinds_text + "; or \"finest\"");
    return truth;
  }
  if (given.contains("when"))
    truth.when = read_condition(given["when"], pointer + "/when", axes, faults);
  std::vector<std::string> present;
  for (const char* kind : kinds)
    if (given.contains(kind)) present.emplace_back(kind);
  if (present.size() != 1) {
    faults.add(pointer, shown(given), kinds_text);
    return truth;
  }
  if (present.front() == "csv") {
    read_table(truth, given, folder, axes, reader);
    return truth;
  }
  reject_others(given, truth, present.front(), faults);
  if (present.front() == "finest") {
    truth.kind = Truth::Kind::finest;
    if (const auto options = reader.read<FinestTruth>(given["finest"], pointer + "/finest"))
      truth.order = options->order;
  } else {
    read_numbers(truth, given, reader);
  }
  return truth;
}

}  // namespace

std::vector<Truth> read_truths(const Json& given, const std::filesystem::path& folder,
                               const std::vector<Axis>& axes, ObjectReader& reader) {
  std::vector<Truth> truths;
  if (!given.is_array()) return {read_truth(given, "/truth", folder, axes, reader)};
  if (given.empty()) reader.faults().add("/truth", "[]", "at least one truth");
  for (std::size_t n = 0; n < given.size(); ++n)
    truths.push_back(read_truth(given[n], member("/truth", n), folder, axes, reader));
  return truths;
}

std::vector<RowFilter> read_filters(const Json& given, const std::string& pointer,
                                    const std::vector<Axis>& axes, ObjectReader& reader) {
  std::vector<RowFilter> filters;
  if (!given.is_object()) {
    reader.faults().add(pointer, shown(given),
                        "an object of the table's columns, each with a value or {\"axis\": name}");
    return filters;
  }
  for (const auto& item : given.items()) {
    const std::string place = member(pointer, item.key());
    const Json& value = item.value();
    RowFilter filter;
    filter.column = item.key();
    if (value.is_object()) {
      const auto options = reader.read<AxisValue>(value, place);
      if (!options) continue;
      const std::size_t axis = find_axis(options->axis, place + "/axis", axes, reader.faults());
      if (axis == axes.size()) continue;
      filter.axis = axis;
      filter.scale = options->scale;
    } else if (value.is_number()) {
      filter.number = value.get<double>();
    } else if (value.is_string()) {
      filter.text = value.get<std::string>();
    } else {
      reader.faults().add(place, shown(value), "a number, a text, or {\"axis\": name}");
      continue;
    }
    filters.push_back(std::move(filter));
  }
  return filters;
}

bool passes(const CsvTable& table, std::size_t row, const std::vector<RowFilter>& filters,
            const std::vector<std::optional<double>>& numbers) {
  constexpr double rounding = 1e-9;
  return std::all_of(filters.begin(), filters.end(), [&](const RowFilter& filter) {
    const auto column = table.column(filter.column);
    if (!column) return false;
    const std::string& cell = table.rows[row][*column];
    std::optional<double> wanted = filter.number;
    if (filter.axis && numbers[*filter.axis]) wanted = *numbers[*filter.axis] * filter.scale;
    if (!wanted) return cell == filter.text;
    const auto number = csv_number(cell);
    return number &&
           std::abs(*number - *wanted) <= rounding * std::max(std::abs(*number), std::abs(*wanted));
  });
}

}  // namespace hyperlattice::study
