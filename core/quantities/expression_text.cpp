#include <base/errors.hpp>
#include <base/visible.hpp>
#include <quantities/expression_text.hpp>
#include <quantities/unit_text.hpp>
#include <quantities/units.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace hyperlattice {

namespace {

constexpr std::size_t longest_expression = 4000;  // bytes of an expression
constexpr std::string_view operators[] = {"<=", ">=", "==", "!=", "&&", "||", "<", ">", "+",
                                          "-",  "*",  "/",  "^",  "?",  ":",  "(", ")", ","};

bool is_cipher(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
/// Returns whether a byte may belong to a symbol of a unit; bytes above 127 are those of "µ".
bool is_of_unit(char c) {
  return begins_name(c) || c == '%' || static_cast<unsigned char>(c) > 127;
}

class Reader {
 public:
  Reader(std::string_view text, std::span<const ExpressionName> names,
         const VariableReader& variable)
      : text_(text), names_(names), variable_(variable) {}

  ExpressionText read() {
    if (text_.size() > longest_expression)
      fail(fmt::format("it is longer than {} characters", longest_expression));
    while (result_.problem.empty() && at_ < text_.size()) read_word();
    return std::move(result_);
  }

 private:
  void fail(std::string sentence) {
    if (result_.problem.empty()) result_.problem = std::move(sentence);
  }
  std::string_view rest(std::size_t from) const {
    return text_.substr(std::min(from, text_.size()));
  }
  char at(std::size_t place) const { return place < text_.size() ? text_[place] : '\0'; }

  void read_word() {
    const char c = text_[at_];
    if (is_blank(c)) {
      result_.plain += ' ';
      ++at_;
    } else if (is_cipher(c) || (c == '.' && is_cipher(at(at_ + 1)))) {
      read_number();
    } else if (rest(at_).starts_with("${")) {
      read_variable();
    } else if (begins_name(c)) {
      read_name();
    } else {
      read_operator();
    }
  }

  void read_operator() {
    for (const std::string_view word : operators)
      if (rest(at_).starts_with(word)) {
        result_.plain += word;
        at_ += word.size();
        return;
      }
    const std::string_view character = rest(at_).substr(0, length_of_character(rest(at_)));
    fail(character == "=" ? "\"==\" compares, and \"=\" stands nowhere"
                          : fmt::format("{} is no part of an expression", quoted(character)));
  }

  void add(Operand operand) {
    result_.plain += ' ' + operand_name(result_.operands.size()) + ' ';
    result_.operands.push_back(operand);
  }

  void read_number() {
    const std::size_t begin = at_;
    double value = 0;
    const char* const first = text_.data() + begin;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    if (error != std::errc() || !std::isfinite(value))
      return fail(fmt::format("{} is too large or too small for double precision",
                              quoted(text_.substr(begin, at_ - begin))));
    if (at(at_) == ',' && is_cipher(at(at_ + 1)) && depth_is_zero())
      return fail("numbers have a decimal point, and no comma");
    const std::size_t unit = skip_blanks(at_);
    if (!is_of_unit(at(unit)) && !is_reciprocal_unit(unit)) return add({value, {}, value == 0, {}});
    at_ = end_of_unit(unit);
    const QuantityValue quantity = read_any_quantity(text_.substr(begin, at_ - begin));
    if (!quantity.problem.empty())
      return fail(
          fmt::format("{}: {}", quoted(text_.substr(begin, at_ - begin)), quantity.problem));
    add({quantity.value, quantity.powers, false, {}});
  }

  /// Returns whether no function is open, so that a comma cannot separate its values.
  bool depth_is_zero() const {
    return std::count(result_.plain.begin(), result_.plain.end(), '(') ==
           std::count(result_.plain.begin(), result_.plain.end(), ')');
  }

  std::size_t skip_blanks(std::size_t place) const {
    while (is_blank(at(place))) ++place;
    return place;
  }

  /// Returns the place behind the "/" of a unit such as "1/s"; 0 if there is none.
  std::size_t behind_reciprocal(std::size_t place) const {
    const std::size_t slash = skip_blanks(place + 1);
    return at(place) == '1' && at(slash) == '/' ? skip_blanks(slash + 1) : 0;
  }
  bool is_reciprocal_unit(std::size_t place) const {
    const std::size_t behind = behind_reciprocal(place);
    return behind > 0 && is_of_unit(at(behind));
  }

  /// Returns the end of the unit that begins at `begin`: its first factor, and all that follow as
  /// long as they are units and no names of the expression.
  std::size_t end_of_unit(std::size_t begin) const {
    std::size_t end = end_of_factor(std::max(begin, behind_reciprocal(begin)));
    while (true) {
      std::size_t next = skip_blanks(end);
      const bool divides = at(next) == '/', dotted = at(next) == '.';
      if (divides || dotted) next = skip_blanks(next + 1);
      if (divides && at(next) == '(') {
        const std::size_t close = text_.find(')', next);
        if (close == std::string_view::npos || !is_unit(begin, close + 1)) return end;
        end = close + 1;
        continue;
      }
      if (!is_of_unit(at(next)) || is_name_at(next)) return end;
      const std::size_t further = end_of_factor(next);
      if (!is_unit(begin, further)) return end;
      end = further;
    }
  }

  /// Returns the end of a symbol and its power. A sign of the power stands behind "^", since
  /// "mm-1" is a subtraction here.
  std::size_t end_of_factor(std::size_t place) const {
    while (is_of_unit(at(place))) ++place;
    std::size_t power = place;
    if (at(power) == '^') {
      ++power;
      if (at(power) == '-' || at(power) == '+') ++power;
    }
    if (!is_cipher(at(power))) return place;
    while (is_cipher(at(power))) ++power;
    return power;
  }

  bool is_unit(std::size_t begin, std::size_t end) const {
    return read_any_quantity("1 " + std::string(text_.substr(begin, end - begin))).problem.empty();
  }

  std::string_view name_at(std::size_t place) const {
    std::size_t end = place;
    while (begins_name(at(end)) || is_cipher(at(end))) ++end;
    return text_.substr(place, end - place);
  }
  bool is_name_at(std::size_t place) const {
    const std::string_view name = name_at(place);
    return name == "pi" || at(place + name.size()) == '(' || find(name) != nullptr;
  }
  const ExpressionName* find(std::string_view name) const {
    const auto found = std::find_if(names_.begin(), names_.end(),
                                    [&](const ExpressionName& one) { return one.name == name; });
    return found == names_.end() ? nullptr : &*found;
  }

  void read_name() {
    const std::string_view name = name_at(at_);
    const auto ask = [](std::string_view word, const std::vector<std::string>& known) {
      const std::string near = nearest(word, known);
      return near.empty() ? fmt::format("; there are {}", fmt::join(known, ", "))
                          : fmt::format("; did you mean \"{}\"?", near);
    };
    at_ += name.size();
    if (at(skip_blanks(at_)) == '(') {
      std::vector<std::string> known;
      for (const FunctionInfo& one : functions()) known.emplace_back(one.name);
      if (std::find(known.begin(), known.end(), name) == known.end())
        return fail(fmt::format("{} is no function{}", quoted(name), ask(name, known)));
      result_.plain += name;
      return;
    }
    if (const ExpressionName* one = find(name)) {
      Operand operand{one->constant.value_or(0), one->powers, false, {}};
      if (!one->constant) operand.input = input_of(*one);
      return add(operand);
    }
    if (name == "pi") return add({std::numbers::pi, {}, false, {}});
    std::vector<std::string> known;
    for (const ExpressionName& one : names_) known.push_back(one.name);
    known.emplace_back("pi");
    fail(fmt::format("the name {} is unknown{}", quoted(name),
                     variable_ && read_any_quantity(fmt::format("1 {}", name)).problem.empty()
                         ? "; a unit stands behind a number, a variable is \"${name}\""
                         : ask(name, known)));
  }
  /// Returns the place of a name among those without a constant.
  std::size_t input_of(const ExpressionName& name) const {
    return static_cast<std::size_t>(std::count_if(
        names_.data(), &name, [](const ExpressionName& one) { return !one.constant.has_value(); }));
  }

  void read_variable() {
    const std::size_t close = text_.find('}', at_);
    if (close == std::string_view::npos) return fail("\"${\" has no \"}\"");
    const std::string name(text_.substr(at_ + 2, close - at_ - 2));
    at_ = close + 1;
    if (!variable_) return fail(fmt::format("\"${{{}}}\" stands where no variable is known", name));
    const QuantityValue quantity = variable_(name);
    if (!quantity.problem.empty()) return fail(quantity.problem);
    add({quantity.value, quantity.powers, false, {}});
  }

  std::string_view text_;
  std::span<const ExpressionName> names_;
  const VariableReader& variable_;
  std::size_t at_ = 0;
  ExpressionText result_;
};

}  // namespace

std::string operand_name(std::size_t n) { return fmt::format("operand_{}", n); }

ExpressionText read_expression_text(std::string_view text, std::span<const ExpressionName> names,
                                    const VariableReader& variable) {
  return Reader(text, names, variable).read();
}

}  // namespace hyperlattice
