#include <base/errors.hpp>
#include <scene/units.hpp>

#include <spdlog/fmt/fmt.h>
#include <udunits2.h>

#include <locale.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace hyperlattice {

namespace {

struct Known {
  const char *unit, *name, *example;
};
// The first of a dimension names it; a unit's own entry comes before that ("J/m2" is an energy per area, "N/m" a stiffness).
constexpr Known known[] = {{"", "a number", "0.5"},
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
                           {"kg/s", "a damping coefficient", "1 kg/s"}};

using Unit = std::unique_ptr<ut_unit, void (*)(ut_unit*)>;
using Converter = std::unique_ptr<cv_converter, void (*)(cv_converter*)>;

/// While it lives, numbers that this thread reads have a decimal point: UDUNITS reads its database and units as the program's locale says.
class PlainNumbers {
 public:
  PlainNumbers() : plain_(::newlocale(LC_ALL_MASK, "C", nullptr)), before_(::uselocale(plain_)) {}
  ~PlainNumbers() {
    ::uselocale(before_);
    ::freelocale(plain_);
  }
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

 private:
  locale_t plain_, before_;
};

/// The units database; UDUNITS keeps its state in globals, so every use holds the lock.
class Database {
 public:
  static Database& instance() {
    static Database database;
    return database;
  }
  std::mutex& lock() { return lock_; }
  /// Null if unknown, and for units with an origin of their own ("seconds since 2000-01-01").
  Unit parse(std::string_view text) const {
    bool sane = text.size() <= 100 && text.find('\0') == std::string_view::npos;
    for (const std::string_view origin : {"@", "since", "after", "from", "ref"}) sane = sane && text.find(origin) == std::string_view::npos;
    const PlainNumbers plain;
    return {sane ? ut_parse(system_, std::string(text).c_str(), UT_UTF8) : nullptr, ut_free};
  }

 private:
  Database() {
    ut_set_error_message_handler(ut_ignore);
    const PlainNumbers plain;
    system_ = ut_read_xml(nullptr);
    if (system_ == nullptr) throw OutsideError("the units database of UDUNITS-2 cannot be read; UDUNITS2_XML_PATH may name its udunits2.xml");
  }
  ut_system* system_ = nullptr;
  std::mutex lock_;
};

/// Exactly the same dimension; UDUNITS alone would also convert between a unit and its reciprocal.
bool same_dimension(const ut_unit* a, const ut_unit* b) {
  const Unit ratio(ut_divide(a, b), ut_free);
  return ratio && ut_is_dimensionless(ratio.get()) != 0;
}

Dimension dimension_of(std::string_view text, const ut_unit* unit, const Database& database) {
  for (const Known& entry : known)
    if (text == entry.unit) return {entry.name, entry.example};
  for (const Known& entry : known) {
    const Unit other = database.parse(entry.unit);
    if (unit != nullptr && other && same_dimension(unit, other.get())) return {entry.name, entry.example};
  }
  return {fmt::format("a quantity in {}", text), fmt::format("1 {}", text)};
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

double parse(std::string_view number) {
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  return error == std::errc() ? value : std::numeric_limits<double>::infinity();
}

/// The number (as text) in SI. Most units are powers of ten of the SI's: then only the exponent changes, and the double nearest to the result
/// is found without a rounding on the way.
double convert(std::string_view number, const cv_converter* converter) {
  const double origin = cv_convert_double(converter, 0), scale = cv_convert_double(converter, 1);
  const std::string digits = fmt::format("{:.12e}", scale), power_of_ten = "1.000000000000e";
  const double plain = parse(number);
  if (plain == 0 || origin != 0 || !digits.starts_with(power_of_ten)) return cv_convert_double(converter, plain);
  const auto split = number.find_first_of("eE");
  const int exponent = split == std::string_view::npos ? 0 : std::stoi(std::string(number.substr(split + 1)));
  return parse(fmt::format("{}e{}", number.substr(0, split), exponent + std::stoi(digits.substr(power_of_ten.size()))));
}

}  // namespace

Dimension dimension_of(std::string_view unit) {
  Database& database = Database::instance();
  const std::lock_guard hold(database.lock());
  return dimension_of(unit, database.parse(unit).get(), database);
}

Quantity read_quantity(std::string_view text, std::string_view unit) {
  const auto problem = [](std::string sentence) { return Quantity{0, std::move(sentence)}; };
  std::string_view rest = trim(text);
  if (rest.size() > 1 && rest.front() == '+' && rest[1] != '-') rest.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range) return problem("the number is too large or too small for double precision");
  if (error != std::errc()) return problem("it does not begin with a number");
  if (!std::isfinite(number)) return problem("it is not finite");
  const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.data())), given = trim(rest.substr(digits.size()));
  if (given.empty())
    return problem(unit.empty() ? "write a plain number without quotation marks" : "it has no unit; a plain number without quotation marks is SI");

  Database& database = Database::instance();
  const std::lock_guard hold(database.lock());
  const bool begins_with_number = std::string_view("0123456789.+-").find(given.front()) != std::string_view::npos;
  const Unit from = begins_with_number && given.substr(0, 2) != "1/" ? Unit(nullptr, ut_free) : database.parse(given), to = database.parse(unit);
  if (!from) return problem(fmt::format("unknown unit \"{}\"", given));
  if (!to) return problem(fmt::format("the option's own unit \"{}\" is unknown", unit));
  if (!same_dimension(from.get(), to.get())) return problem(fmt::format("it is {}", dimension_of(given, from.get(), database).name));
  const Converter converter(ut_get_converter(from.get(), to.get()), cv_free);
  if (!converter) return problem(fmt::format("\"{}\" cannot be converted", given));
  const double value = convert(digits, converter.get());
  if (!std::isfinite(value)) return problem("the number is too large or too small for double precision");
  return {value, ""};
}

}  // namespace hyperlattice
