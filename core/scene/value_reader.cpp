#include <base/input_file.hpp>
#include <quantities/units.hpp>
#include <scene/expectation.hpp>
#include <scene/value_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Reads arithmetic with variables as a quantity of the dimension of `unit`.
Quantity read_arithmetic(const std::string& text, std::string_view unit,
                         const Variables& variables) {
  const QuantityValue found = variables.evaluate(text);
  if (!found.problem.empty()) return {0, found.problem};
  if (same(found.powers, read_any_quantity(fmt::format("1 {}", unit)).powers))
    return {found.value, ""};
  return {0, fmt::format("it is {}{}", dimension_name(found.powers),
                         is_plain_number(found.powers) ? "; give its variables units" : "")};
}

/// Reads a number, a text with a unit, or arithmetic with variables, in SI units.
bool read_number(const Option& option, const Json& given, const std::string& pointer,
                 const std::string& expected, Reading reading, double& number) {
  const auto wrong = [&](const std::string& why) {
    reading.faults.add(pointer, shown(given),
                       why.empty() ? expected : fmt::format("{} ({})", expected, why));
    return false;
  };
  if (given.is_string() && has_variable(given.get_ref<const std::string&>())) {
    const Quantity quantity = read_arithmetic(given.get_ref<const std::string&>(), option.unit,
                                              reading.regions.variables());
    if (!quantity.problem.empty()) return wrong(quantity.problem);
    number = quantity.value;
  } else if (given.is_string()) {
    const Quantity quantity = read_quantity(given.get_ref<const std::string&>(), option.unit);
    if (!quantity.problem.empty()) return wrong(quantity.problem);
    number = quantity.value;
  } else if (given.is_number()) {
    number = given.get<double>();
  } else {
    return wrong("");
  }
  return in_range(option, number) || wrong("");
}

/// Returns whether a text has a variable that is unknown or faulty, which was reported.
bool is_faulty(const Json& given, const Reading& reading) {
  return given.is_string() &&
         reading.regions.variables().is_faulty(given.get_ref<const std::string&>());
}

bool read_integer(const Json& given, std::int64_t& integer) {
  if (given.is_number_unsigned() &&
      given.get<std::uint64_t>() >
          static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    return false;
  if (given.is_number_integer()) {
    integer = given.get<std::int64_t>();
    return true;
  }
  if (!given.is_number()) return false;
  const double number = given.get<double>();  // 1e6 is a whole number, too
  if (std::trunc(number) != number || std::abs(number) > 9e15) return false;
  integer = static_cast<std::int64_t>(number);
  return true;
}

std::vector<std::string> names_of(const Option& option, const Reading& reading) {
  std::vector<std::string> names(option.choices.begin(), option.choices.end());
  if (option.plugin_fields) names.insert(names.end(), reading.fields.begin(), reading.fields.end());
  return names;
}

/// Returns a hint at the choice that a text may mean: a probe takes a component of a field by an
/// option of its own.
std::string hint(const Option& option, const Json& given, const Reading& reading) {
  if (!given.is_string()) return "";
  const auto& text = given.get_ref<const std::string&>();
  const FieldPart meant = option.plugin_fields ? find_field_part(text) : FieldPart();
  if (meant.part.empty()) return did_you_mean(text, names_of(option, reading));
  return fmt::format(
      "; did you mean \"{}\"{}?", meant.field->name,
      option.kind == OptionKind::choice ? fmt::format(" with component \"{}\"", meant.part) : "");
}

/// Returns whether the option takes the name of this field, which a material of the scene declares.
bool is_field(const Option& option, const Json& given, const Reading& reading) {
  return option.plugin_fields && given.is_string() &&
         std::find(reading.fields.begin(), reading.fields.end(),
                   given.get_ref<const std::string&>()) != reading.fields.end();
}

/// Returns the index of a text among the option's choices, or -1.
std::int64_t choice_of(const Option& option, const Json& given) {
  if (!given.is_string()) return -1;
  const auto found =
      std::find(option.choices.begin(), option.choices.end(), given.get_ref<const std::string&>());
  return found == option.choices.end() ? -1 : found - option.choices.begin();
}

bool read_numbers(const Option& option, const Json& given, const std::string& pointer,
                  Reading reading, ReadValue& value, Json& resolved) {
  bool good = true;
  for (std::size_t n = 0; n < given.size(); ++n) {
    double number = 0;
    good = !is_faulty(given[n], reading) &&
           read_number(option, given[n], member(pointer, n), entry_expectation(option), reading,
                       number) &&
           good;
    value.numbers.push_back(number);
  }
  value.plain.numbers = value.numbers;
  resolved = value.numbers;
  return good;
}

/// Replaces the variables in a text. Returns false after a fault.
bool fill_gaps(Json& text, const std::string& pointer, const Reading& reading) {
  if (!text.is_string() || !has_variable(text.get_ref<const std::string&>())) return true;
  std::string problem;
  std::string filled = reading.regions.variables().fill(text.get<std::string>(), problem);
  if (!problem.empty())
    reading.faults.add(pointer, shown(text), "variables that are texts or numbers; " + problem);
  text = std::move(filled);
  return problem.empty();
}

bool read_texts(const Option& option, const Json& given, const std::string& pointer,
                Reading reading, ReadValue& value, Json& resolved) {
  bool good = true;
  for (std::size_t n = 0; n < given.size(); ++n) {
    Json entry = given[n];
    if (!fill_gaps(entry, member(pointer, n), reading)) {
      good = false;
      continue;
    }
    resolved[n] = entry;
    if (!entry.is_string() || (!option.choices.empty() && choice_of(option, entry) < 0 &&
                               !is_field(option, entry, reading))) {
      reading.faults.add(member(pointer, n), shown(entry),
                         entry_expectation(option) + hint(option, entry, reading));
      good = false;
    } else {
      value.texts.push_back(reading.texts.emplace_back(entry.get<std::string>()));
    }
  }
  value.plain.texts = value.texts;
  return good;
}

/// Reads the label of a load. Returns false if the value is none.
bool read_load(const Json& given, std::span<const std::string> loads, LoadOrRegion& value) {
  if (!given.is_string()) return false;
  const auto found = std::find(loads.begin(), loads.end(), given.get_ref<const std::string&>());
  if (found == loads.end()) return false;
  value.load = static_cast<std::int32_t>(found - loads.begin());
  return true;
}

/// Returns a hint at the load or region whose name is nearest; empty if none is near.
std::string nearest_name(const std::string& name, const Reading& reading) {
  std::vector<std::string> candidates = reading.regions.names();
  candidates.insert(candidates.end(), reading.loads.begin(), reading.loads.end());
  return did_you_mean(name, candidates);
}

bool is_number(const Option& option) {
  return option.kind == OptionKind::number || option.kind == OptionKind::integer;
}

}  // namespace

bool read_value(const Option& option, const Json& written, const std::string& pointer,
                Reading reading, ReadValue& value, Json& resolved) {
  Json filled;
  const bool has_gaps = written.is_string() && has_variable(written.get_ref<const std::string&>());
  if (has_gaps) {
    if (is_faulty(written, reading)) return false;
    filled = written;
    if (!is_number(option) && !fill_gaps(filled, pointer, reading)) return false;
  }
  const Json& given = has_gaps ? filled : written;
  const auto wrong = [&](const std::string& more = "") {
    reading.faults.add(pointer, shown(given), expectation(option) + more);
    return false;
  };
  OptionValue& plain = value.plain;
  resolved = given;
  if (!option.word.empty() && given.is_string() &&
      given.get_ref<const std::string&>() == option.word) {
    plain.absent = true;
    return true;
  }
  switch (option.kind) {
    case OptionKind::number:
      if (!read_number(option, given, pointer, expectation(option), reading, plain.number))
        return false;
      resolved = plain.number;
      return true;
    case OptionKind::integer:
      if (has_gaps) {
        if (!read_number(option, given, pointer, expectation(option), reading, plain.number))
          return false;
        resolved = plain.number;
      }
      if (!read_integer(resolved, plain.integer) ||
          !in_range(option, static_cast<double>(plain.integer)))
        return wrong();
      resolved = plain.integer;
      return true;
    case OptionKind::boolean:
      if (!given.is_boolean()) return wrong();
      plain.boolean = given.get<bool>();
      return true;
    case OptionKind::text:
      if (!given.is_string()) return wrong();
      plain.text = reading.texts.emplace_back(given.get<std::string>());
      return true;
    case OptionKind::file: {
      if (!given.is_string()) return wrong();
      const std::filesystem::path file =
          std::filesystem::absolute(reading.regions.folder_of(pointer) / given.get<std::string>())
              .lexically_normal();
      if (const std::string fault = input_file_fault(file); !fault.empty())
        return wrong(fmt::format("; {}: {}", fault, file.string()));
      if (!is_utf8(file.string()))
        return wrong(fmt::format("; a path in UTF-8, and not {}", file.string()));
      reading.regions.files()[pointer] = file;
      plain.text = reading.texts.emplace_back(file.string());
      resolved = file.string();
      return true;
    }
    case OptionKind::choice:
      plain.integer = choice_of(option, given);
      if (is_field(option, given, reading)) {
        plain.text = reading.texts.emplace_back(given.get<std::string>());
        return true;
      }
      if (plain.integer < 0) return wrong(hint(option, given, reading));
      plain.text = option.choices[static_cast<std::size_t>(plain.integer)];
      return true;
    case OptionKind::vector:
      if (!given.is_array() || given.size() != 3) return wrong();
      if (!read_numbers(option, given, pointer, reading, value, resolved)) return false;
      if (!option.nonzero || value.numbers != std::vector<double>(3, 0)) return true;
      reading.faults.add(pointer, shown(given), "a vector that is not zero");
      return false;
    case OptionKind::numbers:
      if (!given.is_array()) return wrong();
      return read_numbers(option, given, pointer, reading, value, resolved);
    case OptionKind::texts:
      if (!given.is_array()) return wrong();
      return read_texts(option, given, pointer, reading, value, resolved);
    case OptionKind::shape:
      plain.shape = reading.regions.read_shape(given, pointer, resolved);
      return plain.shape != nullptr;
    case OptionKind::load_or_region: {
      const auto& several = reading.ambiguous_loads;
      if (given.is_string() && std::find(several.begin(), several.end(),
                                         given.get_ref<const std::string&>()) != several.end())
        return wrong(
            ", which one load has: several loads without a name are of this type, and "
            "only the first is called so; give the loads names");
      if (read_load(given, reading.loads, plain.load_or_region)) return true;
      if (given.is_string() && !reading.regions.knows(given.get_ref<const std::string&>()))
        return wrong(nearest_name(given.get_ref<const std::string&>(), reading));
      const auto id = reading.regions.read_id(given, pointer, resolved);
      plain.load_or_region.region = id.value_or(RegionId{});
      return id.has_value();
    }
    case OptionKind::region: {
      const auto id = reading.regions.read_id(given, pointer, resolved);
      plain.region = id.value_or(RegionId{});
      return id.has_value();
    }
  }
  return wrong();
}

}  // namespace hyperlattice
