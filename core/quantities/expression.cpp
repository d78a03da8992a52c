#include <quantities/expression.hpp>
#include <quantities/expression_text.hpp>

#include <spdlog/fmt/fmt.h>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hyperlattice {

namespace {

constexpr double nothing = 0;

/// Stands for a function in muParser, which only says where it is called.
double call_of(void*, const double*, int) { return nothing; }
double minus_of(double) { return nothing; }
double plus_of(double) { return nothing; }

/// muParser's grammar with the functions of expressions, without its own names.
class Grammar final : public mu::ParserBase {
 public:
  Grammar() {
    EnableOptimizer(false);  // its list of operations is translated one by one
    InitCharSets();
    InitFun();
    InitOprt();
  }

 private:
  void InitCharSets() override {
    DefineNameChars("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*^/?<>=!%&|~'_");
    DefineInfixOprtChars("/+-*^?<>=!%&|~'_");
  }
  void InitFun() override {
    for (const FunctionInfo& one : functions())
      DefineFunUserData(std::string(one.name), call_of, const_cast<FunctionInfo*>(&one), false);
  }
  void InitConst() override {}
  void InitOprt() override {
    DefineInfixOprt("-", minus_of, mu::prINFIX, false);
    DefineInfixOprt("+", plus_of, mu::prINFIX, false);
  }
};

const std::map<mu::ECmdCode, std::pair<Operation, const char*>>& binary_operations() {
  static const std::map<mu::ECmdCode, std::pair<Operation, const char*>> all{
      {mu::cmADD, {Operation::add, "+"}},           {mu::cmSUB, {Operation::subtract, "-"}},
      {mu::cmMUL, {Operation::multiply, "*"}},      {mu::cmDIV, {Operation::divide, "/"}},
      {mu::cmPOW, {Operation::power, "^"}},         {mu::cmLT, {Operation::less, "<"}},
      {mu::cmLE, {Operation::less_equal, "<="}},    {mu::cmGT, {Operation::greater, ">"}},
      {mu::cmGE, {Operation::greater_equal, ">="}}, {mu::cmEQ, {Operation::equal, "=="}},
      {mu::cmNEQ, {Operation::not_equal, "!="}},    {mu::cmLAND, {Operation::both, "&&"}},
      {mu::cmLOR, {Operation::either, "||"}}};
  return all;
}

bool compares(Operation operation) {
  return operation >= Operation::less && operation <= Operation::not_equal;
}
bool joins(Operation operation) {
  return operation == Operation::both || operation == Operation::either;
}

/// Translates muParser's list of operations, and checks dimensions.
class Translation {
 public:
  explicit Translation(const std::vector<Operand>& operands) : operands_(operands) {}

  Expression translate(const mu::ParserByteCode& list, const std::vector<double>& places) {
    const mu::SToken* const tokens = list.GetBase();
    for (std::size_t n = 0; n < list.GetSize() && tokens[n].Cmd != mu::cmEND && good(); ++n)
      take(tokens[n], places.data());
    if (good() && stack_.size() != 1) fail("it is a list of several values");
    if (!good()) return {{}, {}, false, std::move(problem_)};
    const Term result = stack_.back();
    if (result.place + 1u != code_.size()) {  // a constant or an input that stands before others
      Instruction last = code_[result.place];
      code_.push_back(last);
    }
    return {Compiled(code_), result.powers, result.is_condition, ""};
  }

 private:
  /// A value on muParser's stack.
  struct Term {
    std::uint16_t place = 0;
    Powers powers{};
    bool is_condition = false, is_any = false;  ///< is_any: a plain 0
  };

  bool good() const { return problem_.empty(); }
  void fail(std::string sentence) {
    if (good()) problem_ = std::move(sentence);
  }
  Term pop() {
    if (stack_.empty()) {
      fail("it is cut short");
      return {};
    }
    const Term term = stack_.back();
    stack_.pop_back();
    return term;
  }
  bool is_constant(const Term& term) const {
    return code_[term.place].operation == Operation::constant;
  }

  /// Adds an instruction, or its value if all that it takes is constant.
  void push(Instruction one, Term result, std::initializer_list<Term> taken) {
    if (!good()) return;
    const bool known =
        taken.size() > 0 &&
        std::all_of(taken.begin(), taken.end(), [&](const Term& t) { return is_constant(t); });
    if (known) {
      const double value =
          value_of(one, code_[one.a].value, code_[one.b].value, code_[one.c].value);
      one = {};
      one.value = value;
    }
    // One place is left for the result.
    if (code_.size() + 1 >= most_instructions) return fail("it has too many operations");
    result.place = static_cast<std::uint16_t>(code_.size());
    code_.push_back(one);
    stack_.push_back(result);
  }

  void take(const mu::SToken& token, const double* places) {
    switch (token.Cmd) {
      case mu::cmVAR:
        return push_operand(operands_[static_cast<std::size_t>(token.Val.ptr - places)]);
      case mu::cmIF:
        return begin_choice();
      case mu::cmELSE:
        return;
      case mu::cmENDIF:
        return end_choice();
      case mu::cmFUNC:
        return call(token);
      default:
        break;
    }
    const auto found = binary_operations().find(token.Cmd);
    if (found == binary_operations().end()) return fail("it holds an operation that is not known");
    const Term b = pop(), a = pop();
    if (good()) combine(found->second.first, found->second.second, a, b);
  }

  void push_operand(const Operand& operand) {
    Instruction one;
    one.value = operand.value;
    if (operand.input) {
      one.operation = Operation::input;
      one.a = static_cast<std::uint16_t>(*operand.input);
    }
    push(one, {0, operand.powers, false, operand.is_zero_word}, {});
  }

  bool is_quantity(const Term& term, const std::string& where) {
    if (term.is_condition) fail(fmt::format("{} takes numbers, and not a condition", where));
    return !term.is_condition;
  }
  /// Checks that both have one dimension, which is returned.
  Powers common(const Term& a, const Term& b, const std::string& where) {
    if (a.is_any) return b.powers;
    if (!b.is_any && !same(a.powers, b.powers))
      fail(fmt::format("{} stands between {} and {}", where, dimension_name(a.powers),
                       dimension_name(b.powers)));
    return a.powers;
  }

  void combine(Operation operation, const std::string& word, const Term& a, const Term& b) {
    const Instruction one{operation, {}, a.place, b.place, 0, 0};
    const std::string where = '"' + word + '"';
    Term result;
    if (joins(operation)) {
      if (!a.is_condition || !b.is_condition)
        return fail(fmt::format("{} joins conditions, such as \"strain > 0.1\"", where));
      result.is_condition = true;
    } else if (!is_quantity(a, where) || !is_quantity(b, where)) {
      return;
    } else if (operation == Operation::multiply) {
      result.powers = product(a.powers, b.powers);
      result.is_any = a.is_any || b.is_any;
    } else if (operation == Operation::divide) {
      result.powers = quotient(a.powers, b.powers);
      result.is_any = a.is_any;
    } else if (operation == Operation::power) {
      if (!is_plain_number(b.powers))
        return fail(fmt::format("a power is a number, and not {}", dimension_name(b.powers)));
      if (!is_plain_number(a.powers) && !is_constant(b))
        return fail(fmt::format("a power of {} is a constant number", dimension_name(a.powers)));
      if (!is_plain_number(a.powers)) result.powers = raised(a.powers, code_[b.place].value);
    } else {
      result.powers = common(a, b, where);
      result.is_any = a.is_any && b.is_any;
      if (compares(operation)) result = {0, {}, true, false};
    }
    push(one, result, {a, b});
  }

  void begin_choice() {
    const Term condition = pop();
    if (good() && !condition.is_condition)
      fail("before \"?\" stands a condition, such as \"strain > 0.1\"");
    conditions_.push_back(condition);
  }
  void end_choice() {
    const Term c = pop(), b = pop();
    if (!good() || conditions_.empty()) return fail("\"?\" and \":\" do not agree");
    const Term condition = conditions_.back();
    conditions_.pop_back();
    if (b.is_condition != c.is_condition)
      return fail("beside \":\" stand two numbers or two conditions");
    Term result{0, {}, b.is_condition, b.is_any && c.is_any};
    if (!b.is_condition) result.powers = common(b, c, "\":\"");
    push({Operation::select, {}, condition.place, b.place, c.place, 0}, result, {condition, b, c});
  }

  void call(const mu::SToken& token) {
    if (token.Fun.cb ==
        mu::generic_callable_type{reinterpret_cast<mu::erased_fun_type>(minus_of), nullptr}) {
      const Term a = pop();
      if (good() && is_quantity(a, "\"-\""))
        push({Operation::negate, {}, a.place, 0, 0, 0}, {0, a.powers, false, a.is_any}, {a});
      return;
    }
    if (token.Fun.cb._pUserData == nullptr) {  // a plus sign
      if (good() && !stack_.empty()) is_quantity(stack_.back(), "\"+\"");
      return;
    }
    const auto& info = *static_cast<const FunctionInfo*>(token.Fun.cb._pUserData);
    const std::string where = fmt::format("\"{}\"", info.name);
    const int count = std::abs(token.Fun.argc);
    if (info.values == 0 ? count == 0 : count != info.values)
      return fail(fmt::format(
          "{} takes {}", where,
          info.values == 0 ? std::string("one value or more")
                           : fmt::format("{} value{}", info.values, info.values == 1 ? "" : "s")));
    std::vector<Term> taken;
    for (int n = 0; n < count && good(); ++n) taken.push_back(pop());
    std::reverse(taken.begin(), taken.end());
    for (const Term& term : taken)
      if (!good() || !is_quantity(term, where)) return;
    apply(info, where, taken);
  }

  void apply(const FunctionInfo& info, const std::string& where, const std::vector<Term>& taken) {
    Term result{0, {}, false, false};
    Powers angle{};
    angle[7] = 1;
    for (std::size_t n = 1; n < taken.size(); ++n) common(taken[n - 1], taken[n], where);
    switch (info.dimensions) {
      case FunctionDimensions::angle:
        if (same(taken[0].powers, angle)) break;
        [[fallthrough]];
      case FunctionDimensions::numbers:
        if (!is_plain_number(taken[0].powers))
          fail(
              fmt::format("{} takes a number, and not {}", where, dimension_name(taken[0].powers)));
        break;
      case FunctionDimensions::kept:
        result.is_any = true;
        for (const Term& term : taken) {
          if (!term.is_any) result.powers = term.powers;
          result.is_any = result.is_any && term.is_any;
        }
        break;
      case FunctionDimensions::root:
        result.powers = raised(taken[0].powers, 0.5);
        break;
      case FunctionDimensions::ratio:
        break;
    }
    if (!good()) return;
    if (info.function == Function::atan2)
      return push({Operation::atan2, {}, taken[0].place, taken[1].place, 0, 0}, result,
                  {taken[0], taken[1]});
    if (info.values == 1)
      return push({Operation::call, info.function, taken[0].place, 0, 0, 0}, result, {taken[0]});
    fold(info.function, taken, result);
  }

  /// Adds a function of any number of values, two by two.
  void fold(Function function, const std::vector<Term>& taken, const Term& result) {
    Operation operation = Operation::add;
    if (function == Function::min) operation = Operation::minimum;
    if (function == Function::max) operation = Operation::maximum;
    stack_.push_back(taken[0]);
    stack_.back().powers = result.powers;
    for (std::size_t n = 1; n < taken.size() && good(); ++n) {
      const Term a = pop();
      push({operation, {}, a.place, taken[n].place, 0, 0}, result, {a, taken[n]});
    }
    if (function != Function::avg || !good()) return;
    const Term total = pop();
    push_operand({static_cast<double>(taken.size()), {}, false, {}});
    const Term count = pop();
    push({Operation::divide, {}, total.place, count.place, 0, 0}, result, {total, count});
  }

  const std::vector<Operand>& operands_;
  std::vector<Instruction> code_;
  std::vector<Term> stack_, conditions_;
  std::string problem_;
};

/// Returns muParser's reason in words of its own, without the names of operands.
std::string reason_of(const mu::ParserError& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
    case mu::ecEMPTY_EXPRESSION:
      return "it is empty, or cut short";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecUNEXPECTED_PARENS:
      return "a parenthesis stands where none can be";
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_FUN:
      return "an operator is missing between two values";
    case mu::ecUNEXPECTED_OPERATOR:
      return fmt::format("the operator \"{}\" has nothing to act on", error.GetToken());
    case mu::ecUNEXPECTED_ARG_SEP:
      return "a comma stands outside of a function; numbers have a decimal point";
    case mu::ecMISSING_ELSE_CLAUSE:
    case mu::ecUNEXPECTED_CONDITIONAL:
    case mu::ecMISPLACED_COLON:
      return "\"?\" and \":\" do not agree";
    case mu::ecTOO_FEW_PARAMS:
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("the function \"{}\" takes another number of values", error.GetToken());
    default:
      return "muParser: " + error.GetMsg();
  }
}

}  // namespace

Expression compile_expression(std::string_view text, std::span<const ExpressionName> names,
                              const VariableReader& variable) {
  const auto refused = [](std::string problem) {
    return Expression{{}, {}, false, std::move(problem)};
  };
  ExpressionText words = read_expression_text(text, names, variable);
  if (!words.problem.empty()) return refused(std::move(words.problem));
  std::vector<double> places(words.operands.size() + 1, nothing);
  try {
    Grammar grammar;
    for (std::size_t n = 0; n < words.operands.size(); ++n)
      grammar.DefineVar(operand_name(n), &places[n]);
    grammar.SetExpr(words.plain);
    int values = 0;
    grammar.Eval(values);  // makes the list of operations
    if (values != 1) return refused("it is a list of several values");
    return Translation(words.operands).translate(grammar.GetByteCode(), places);
  } catch (const mu::ParserError& error) {
    return refused(reason_of(error));
  }
}

QuantityValue evaluate_expression(std::string_view text, const VariableReader& variable) {
  const Expression expression = compile_expression(text, {}, variable);
  if (!expression.problem.empty()) return {0, {}, expression.problem};
  if (expression.is_condition) return {0, {}, "it is a condition, and no number"};
  const double value = (*expression.compiled)({});
  if (!std::isfinite(value)) return {0, {}, "its value is no finite number"};
  return {value, expression.powers, ""};
}

}  // namespace hyperlattice
