#include <base/visible.hpp>
#include <quantities/unit_text.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::size_t longest_unit = 100;  // bytes
constexpr int highest_power = 12;

constexpr std::string_view blanks[] = {" ", "\t", "\r", "\n", "\u00A0", "\u202F", "\u2009"};
constexpr std::string_view dots[] = {"*", ".", "\u00B7", "\u22C5"};
constexpr std::string_view symbols[] = {
    "%",      "_",      "\u00B5", "\u03BC",
    "\u03A9", "\u2126", "\u00B0", "\u00C5"};  // besides a to z: mu, ohm, degree, Angstrom
constexpr std::string_view raised[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
constexpr std::string_view raised_minus = "\u207B";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : rest_(text) {}

  UnitText read() {
    if (take("1")) {
      skip_blanks();
      if (!rest_.starts_with('/'))
        fail(fmt::format("a number stands where the unit should be: {}", quoted(given_)));
    } else if (!rest_.empty() && is_digit(rest_.front())) {
      fail(fmt::format("a number stands where the unit should be: {}", quoted(given_)));
    } else {
      read_product(1);
    }
    while (good() && skip_blanks() && !rest_.empty()) {
      if (!take("/")) {
        fail_here(after_quotient_
                      ? "after \"/\" a product stands in parentheses, as in \"kg/(m s2)\""
                      : "");
        break;
      }
      skip_blanks();
      after_quotient_ = true;
      if (rest_.starts_with('('))
        read_group(-1);
      else
        read_factor(-1);
    }
    return std::move(unit_);
  }

 private:
  bool good() const { return unit_.problem.empty(); }
  void fail(std::string problem) {
    if (good()) unit_.problem = std::move(problem);
  }
  /// Fails at the current position with a description of the text there, or with `problem` if that
  /// says more.
  void fail_here(std::string problem = "") {
    if (rest_.empty()) return fail("the unit is cut short");
    const std::string_view character = rest_.substr(0, length_of_character(rest_));
    const bool is_number = is_digit(character.front()) || ((character == "+" || character == "-") &&
                                                           rest_.size() > 1 && is_digit(rest_[1]));
    if (is_number)
      fail(fmt::format("a number stands after the unit: {}", quoted(rest_)));
    else if (!problem.empty() && (is_symbol(rest_) > 0 || character == "("))
      fail(std::move(problem));
    else
      fail(fmt::format("{} is no part of a unit", quoted(character)));
  }

  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  template <std::size_t N>
  bool take_any(const std::string_view (&tokens)[N]) {
    return std::any_of(std::begin(tokens), std::end(tokens),
                       [this](std::string_view token) { return take(token); });
  }
  bool skip_blanks() {
    while (take_any(blanks)) {
    }
    return true;
  }
  /// Returns the number of bytes of the symbol character at the start; 0 if there is none.
  static std::size_t is_symbol(std::string_view text) {
    if (text.empty()) return 0;
    const char c = text.front();
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) return 1;
    for (const std::string_view symbol : symbols)
      if (text.starts_with(symbol)) return symbol.size();
    return 0;
  }

  /// Reads factors, separated by blanks or a dot, as long as there are any.
  void read_product(int sign) {
    if (rest_.starts_with('(')) return read_group(sign);
    read_factor(sign);
    while (good()) {
      skip_blanks();
      const bool dotted = !rest_.starts_with("**") && take_any(dots);
      if (dotted) skip_blanks();
      if (is_symbol(rest_) == 0) {
        if (dotted) fail_here();
        return;
      }
      read_factor(sign);
    }
  }
  void read_group(int sign) {
    take("(");
    skip_blanks();
    read_factors_of_group(sign);
  }
  void read_factors_of_group(int sign) {
    if (rest_.starts_with('(')) return fail("parentheses stand within others");
    read_product(sign);
    if (good() && !take(")")) fail_here(rest_.empty() ? "" : "a parenthesis is not closed");
  }
  void read_factor(int sign) {
    const std::string_view begin = rest_;
    while (const std::size_t length = is_symbol(rest_)) rest_.remove_prefix(length);
    const std::string_view symbol = begin.substr(0, begin.size() - rest_.size());
    if (symbol.empty()) return fail_here();
    unit_.factors.push_back({symbol, sign * read_power()});
  }
  int read_power() {
    int power = 0;
    bool negative = false, any = false;
    const auto add = [&](int digit) {
      any = true;
      power = std::min(10 * power + digit, highest_power + 1);
    };
    if (rest_.starts_with(raised_minus) || raised_digit() >= 0) {
      negative = take(raised_minus);
      for (int digit = raised_digit(); digit >= 0; digit = raised_digit()) {
        take(raised[digit]);
        add(digit);
      }
    } else {
      const bool marked = take("**") || take("^");
      const bool has_sign =
          rest_.size() > 1 && (rest_.front() == '-' || rest_.front() == '+') && is_digit(rest_[1]);
      if (!marked && !has_sign && (rest_.empty() || !is_digit(rest_.front()))) return 1;
      if (has_sign) {
        negative = rest_.front() == '-';
        rest_.remove_prefix(1);
      }
      for (; !rest_.empty() && is_digit(rest_.front()); rest_.remove_prefix(1))
        add(rest_.front() - '0');
    }
    if (!any || power == 0 || power > highest_power)
      fail(fmt::format("the power of a unit is a whole number from 1 to {}", highest_power));
    return negative ? -power : power;
  }
  int raised_digit() const {
    for (int digit = 0; digit < 10; ++digit)
      if (rest_.starts_with(raised[digit])) return digit;
    return -1;
  }

  std::string_view rest_, given_ = rest_;
  bool after_quotient_ = false;
  UnitText unit_;
};

}  // namespace

UnitText read_unit(std::string_view text) {
  text = trim_blanks(text);
  if (text.empty()) return {};
  if (text.size() > longest_unit)
    return {{}, fmt::format("the unit is longer than {} bytes: {}", longest_unit, quoted(text))};
  return UnitReader(text).read();
}

std::string_view trim_blanks(std::string_view text) {
  const auto is_before = [&](std::string_view blank) { return text.starts_with(blank); };
  const auto is_behind = [&](std::string_view blank) { return text.ends_with(blank); };
  for (const auto* blank = std::begin(blanks);
       (blank = std::find_if(std::begin(blanks), std::end(blanks), is_before)) != std::end(blanks);)
    text.remove_prefix(blank->size());
  for (const auto* blank = std::begin(blanks);
       (blank = std::find_if(std::begin(blanks), std::end(blanks), is_behind)) != std::end(blanks);)
    text.remove_suffix(blank->size());
  return text;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t most = 60;  // bytes
  return '"' + visible(text, most) + '"';
}

}  // namespace hyperlattice
