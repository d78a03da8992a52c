#include <base/errors.hpp>
#include <process/room.hpp>
#include <quantities/unit_text.hpp>
#include <quantities/units.hpp>

#include <spdlog/fmt/fmt.h>
#include <udunits2.h>

#include <locale.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <new>

namespace hyperlattice {

namespace {

struct KnownUnit {
  const char *unit, *name, *example;
};
// The first entry of a dimension gives its name. An entry with exactly the same unit has priority
// ("J/m2" is an energy per area, "N/m" a stiffness).
constexpr KnownUnit known[] = {{"", "a number", "0.5"},
                               {"m", "a length", "1 mm"},
                               {"s", "a time", "1 us"},
                               {"kg", "a mass", "1 g"},
                               {"K", "a temperature", "300 K"},
                               {"rad", "an angle", "90 degrees"},
                               {"m2", "an area", "1 mm2"},
                               {"m3", "a volume", "1 mm3"},
                               {"1/s", "a rate", "1 kHz"},
                               {"m/s", "a velocity", "1 m/s"},
                               {"m/s2", "an acceleration", "9.81 m/s2"},
                               {"kg/m3", "a density", "2500 kg/m3"},
                               {"N", "a force", "1 kN"},
                               {"Pa", "a pressure", "1 MPa"},
                               {"J", "an energy", "1 J"},
                               {"W", "a power", "1 W"},
                               {"N/m", "a stiffness", "1 kN/m"},
                               {"J/m2", "an energy per area", "1 J/m2"},
                               {"Pa s", "a viscosity", "1 Pa s"},
                               {"kg/s", "a damping coefficient", "1 kg/s"},
                               {"rad/s", "an angular velocity", "1 rad/s"}};

/// Prefixes of a unit's symbol or name; at most one is allowed.
constexpr std::string_view prefixes[] = {
    "yotta", "zetta", "exa",    "peta",   "tera", "giga", "mega",  "kilo", "hecto", "deca",  "deka",
    "deci",  "centi", "milli",  "micro",  "nano", "pico", "femto", "atto", "zepto", "yocto", "Y",
    "Z",     "E",     "P",      "T",      "G",    "M",    "k",     "h",    "da",    "d",     "c",
    "m",     "u",     "\u00B5", "\u03BC", "n",    "p",    "f",     "a",    "z",     "y"};

using Unit = std::unique_ptr<ut_unit, void (*)(ut_unit*)>;
using Converter = std::unique_ptr<cv_converter, void (*)(cv_converter*)>;

/// Makes this thread read numbers with a decimal point while it exists, since UDUNITS uses the
/// program's locale for its database and for units.
class NumberLocale {
 public:
  NumberLocale() : plain_(::newlocale(LC_ALL_MASK, "C", nullptr)), before_(::uselocale(plain_)) {}
  ~NumberLocale() {
    ::uselocale(before_);
    ::freelocale(plain_);
  }
  NumberLocale(const NumberLocale&) = delete;
  NumberLocale& operator=(const NumberLocale&) = delete;

 private:
  locale_t plain_, before_;
};

/// Returns a unit in base units, radians included: "1e+06 kg.m-1.s-2". Empty if the text is longer
/// than 255 characters, which no useful unit is.
std::string definition(const ut_unit* unit) {
  char text[256];
  const NumberLocale plain;
  const int length = ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION);
  return length > 0 && length < static_cast<int>(sizeof text)
             ? std::string(text, static_cast<std::size_t>(length))
             : std::string();
}

bool is_percent(std::string_view symbol) { return symbol == "%" || symbol == "percent"; }

/// Returns a question for an unknown unit, as the end of a sentence: a unit that differs in capital
/// letters only, or "degrees" for "deg". Empty if there is none.
std::string meant_instead(std::string_view symbol) {
  constexpr std::string_view common[] = {"GPa", "MPa", "kPa", "Pa", "GHz", "MHz", "kHz", "Hz",
                                         "MN",  "kN",  "N",   "km", "mm",  "cm",  "um",  "nm",
                                         "m",   "ms",  "us",  "ns", "s",   "kg",  "mg",  "g",
                                         "kJ",  "MJ",  "J",   "kW", "MW",  "W",   "K",   "rad"};
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  const auto is_alike = [&](std::string_view other) {
    return std::equal(symbol.begin(), symbol.end(), other.begin(), other.end(),
                      [&](char a, char b) { return lower(a) == lower(b); });
  };
  if (is_alike("deg") || is_alike("degs")) return "; did you mean \"degrees\"?";
  const auto* found = std::find_if(std::begin(common), std::end(common), is_alike);
  return found == std::end(common) ? "" : fmt::format("; did you mean \"{}\"?", *found);
}

/// The units database. UDUNITS has global state, so every use holds the lock.
class Database {
 public:
  static Database& instance() {
    static Database database;
    return database;
  }
  std::mutex& lock() { return lock_; }
  /// Parses a unit. Returns null, with the reason in `problem`, if the grammar does not allow it or
  /// a symbol is unknown.
  Unit parse(std::string_view text, std::string& problem) const {
    const UnitText read = read_unit(text);
    problem = read.problem;
    Unit unit(ut_get_dimensionless_unit_one(system_), ut_free);
    for (const UnitFactor& factor : read.factors) {
      if (!problem.empty()) break;
      const Unit symbol = known_symbol(factor.symbol);
      if (!symbol) {
        problem =
            fmt::format("unknown unit {}{}", quoted(factor.symbol), meant_instead(factor.symbol));
      } else if (is_percent(factor.symbol) && &factor != &read.factors.front()) {
        problem = fmt::format("{} stands behind a unit", quoted(factor.symbol));
      } else if (definition(symbol.get()).find_first_of("@(") != std::string::npos) {
        problem =
            fmt::format("{} does not begin at zero, or is a logarithm", quoted(factor.symbol));
      } else {
        const Unit power(ut_raise(symbol.get(), factor.power), ut_free);
        unit.reset(power ? ut_multiply(unit.get(), power.get()) : nullptr);
        if (!unit) problem = fmt::format("{} cannot be computed with", quoted(text));
      }
    }
    if (!problem.empty()) unit.reset();
    return unit;
  }
  Unit parse(std::string_view text) const {
    std::string problem;
    return parse(text, problem);
  }

 private:
  Database() {
    // bytes; without memory UDUNITS ends the program by an assertion
    constexpr double enough = 16e6;
    if (memory_room().bytes < enough) throw std::bad_alloc();
    ut_set_error_message_handler(ut_ignore);
    const NumberLocale plain;
    system_ = ut_read_xml(nullptr);
    if (system_ == nullptr)
      throw OutsideError(
          "the units database of UDUNITS-2 cannot be read; UDUNITS2_XML_PATH may name its "
          "udunits2.xml");
  }
  bool knows(std::string_view symbol) const {
    const std::string text(symbol);
    return Unit(ut_get_unit_by_symbol(system_, text.c_str()), ut_free) ||
           Unit(ut_get_unit_by_name(system_, text.c_str()), ut_free);
  }
  /// Returns the unit of a symbol with at most one prefix. UDUNITS alone accepts any number of
  /// prefixes, so that "mmm" would be a micrometre.
  Unit known_symbol(std::string_view symbol) const {
    const bool known =
        knows(symbol) ||
        std::any_of(std::begin(prefixes), std::end(prefixes), [&](std::string_view prefix) {
          return symbol.size() > prefix.size() && symbol.starts_with(prefix) &&
                 knows(symbol.substr(prefix.size()));
        });
    const NumberLocale plain;
    return {known ? ut_parse(system_, std::string(symbol).c_str(), UT_UTF8) : nullptr, ut_free};
  }

  ut_system* system_ = nullptr;
  std::mutex lock_;
};

/// Returns whether two units have exactly the same dimension. UDUNITS alone would convert between a
/// unit and its reciprocal, and takes radians for plain numbers, so that 60 turns a minute would be
/// 6.28 Hz.
bool same_dimension(const ut_unit* a, const ut_unit* b) {
  const Unit ratio(ut_divide(a, b), ut_free);
  if (!ratio) return false;
  const std::string text = definition(ratio.get());
  return !text.empty() && text.find_first_not_of("0123456789.+-e ") == std::string::npos;
}

Dimension dimension_of(std::string_view text, const ut_unit* unit, const Database& database) {
  for (const KnownUnit& entry : known)
    if (text == entry.unit) return {entry.name, entry.example};
  for (const KnownUnit& entry : known) {
    const Unit other = database.parse(entry.unit);
    if (unit != nullptr && other && same_dimension(unit, other.get()))
      return {entry.name, entry.example};
  }
  return {fmt::format("a quantity in {}", text), fmt::format("1 {}", text)};
}

double parse(std::string_view number) {
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  return error == std::errc() ? value : std::numeric_limits<double>::infinity();
}

/// Converts a number (as text) to SI. If the unit is a power of ten of the SI unit, as most are,
/// only the exponent changes, so that the result is the nearest double without intermediate
/// rounding.
double convert(std::string_view number, const cv_converter* converter) {
  const double origin = cv_convert_double(converter, 0), scale = cv_convert_double(converter, 1);
  const std::string digits = fmt::format("{:.12e}", scale), power_of_ten = "1.000000000000e";
  const double plain = parse(number);
  if (plain == 0 || origin != 0 || !digits.starts_with(power_of_ten))
    return cv_convert_double(converter, plain);
  const auto split = number.find_first_of("eE");
  const int exponent =
      split == std::string_view::npos ? 0 : std::stoi(std::string(number.substr(split + 1)));
  return parse(fmt::format("{}e{}", number.substr(0, split),
                           exponent + std::stoi(digits.substr(power_of_ten.size()))));
}

}  // namespace

Dimension dimension_of(std::string_view unit) {
  Database& database = Database::instance();
  const std::lock_guard hold(database.lock());
  return dimension_of(unit, database.parse(unit).get(), database);
}

namespace {

/// The number of a quantity and its unit, as texts.
struct Split {
  std::string_view digits, unit;
  std::string problem;
};

/// Divides "<number> <unit>"; the unit may be empty.
Split split(std::string_view text) {
  const auto problem = [](std::string sentence) { return Split{{}, {}, std::move(sentence)}; };
  std::string_view rest = trim_blanks(text);
  if (rest.size() > 1 && rest.front() == '+' && rest[1] != '-') rest.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range)
    return problem("the number is too large or too small for double precision");
  if (error != std::errc()) return problem("it does not begin with a number");
  if (!std::isfinite(number)) return problem("it is not finite");
  const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.data())),
                         given = trim_blanks(rest.substr(digits.size()));
  if (given.starts_with(',') || given.starts_with('\'') || given.starts_with('_'))
    return problem(fmt::format(
        "{} stands in the number: it has a decimal point, and nothing between thousands",
        quoted(given.substr(0, 1))));
  return {digits, given, ""};
}

/// Returns the powers of the base units in a definition such as "1e+06 kg.m-1.s-2".
Powers powers_of(std::string_view definition) {
  Powers powers{};
  for (std::size_t n = 0; n < powers.size(); ++n) {
    const std::string_view name = base_units[n];
    for (std::size_t at = definition.find(name); at != std::string_view::npos;
         at = definition.find(name, at + 1)) {
      const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      };
      const std::size_t end = at + name.size();
      if ((at > 0 && is_letter(definition[at - 1])) ||
          (end < definition.size() && is_letter(definition[end])))
        continue;  // "m" in "mol"
      int power = 1;
      std::from_chars(definition.data() + end, definition.data() + definition.size(), power);
      powers[n] = power;
    }
  }
  return powers;
}

}  // namespace

QuantityValue read_any_quantity(std::string_view text) {
  const auto problem = [](std::string sentence) {
    return QuantityValue{0, {}, std::move(sentence)};
  };
  const Split given = split(text);
  if (!given.problem.empty()) return problem(given.problem);
  Database& database = Database::instance();
  const std::lock_guard hold(database.lock());
  std::string why;
  const Unit from = database.parse(given.unit, why);
  if (!from) return problem(why);
  const Powers powers = powers_of(definition(from.get()));
  const Unit to = database.parse(unit_text_of(powers));
  const Converter converter(to ? ut_get_converter(from.get(), to.get()) : nullptr, cv_free);
  if (!converter) return problem(fmt::format("{} cannot be computed with", quoted(given.unit)));
  const double value = convert(given.digits, converter.get());
  if (!std::isfinite(value))
    return problem("the number is too large or too small for double precision");
  return {value, powers, ""};
}

Quantity read_quantity(std::string_view text, std::string_view unit) {
  const auto problem = [](std::string sentence) { return Quantity{0, std::move(sentence)}; };
  const Split split_text = split(text);
  if (!split_text.problem.empty()) return problem(split_text.problem);
  const std::string_view digits = split_text.digits, given = split_text.unit;
  if (given.empty())
    return problem(unit.empty() ? "write a plain number without quotation marks"
                                : "it has no unit; a plain number without quotation marks is SI");

  Database& database = Database::instance();
  const std::lock_guard hold(database.lock());
  std::string why;
  const Unit from = database.parse(given, why), to = database.parse(unit);
  if (!from) return problem(why);
  if (!to) return problem(fmt::format("the option's own unit \"{}\" is unknown", unit));
  if (!same_dimension(from.get(), to.get()))
    return problem(fmt::format("it is {}", dimension_of(given, from.get(), database).name));
  const Converter converter(ut_get_converter(from.get(), to.get()), cv_free);
  if (!converter) return problem(fmt::format("{} cannot be converted", quoted(given)));
  const double value = convert(digits, converter.get());
  if (!std::isfinite(value))
    return problem("the number is too large or too small for double precision");
  return {value, ""};
}

}  // namespace hyperlattice
