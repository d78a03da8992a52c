// Expressions of time of loads.expression: each is refused when it is read, or evaluated at some
// times. muParser comes as a library of the system, whose branches libFuzzer does not see. So half
// of the inputs, by the first byte, are rows of words, of which more are expressions.
#include "../../plugins/loads/expression/expression.cpp"

#include "target.hpp"

namespace {

constexpr std::string_view words[] = {
    "t",    "pi",    "_e",    "1",      "0",      "2.5",   "1e-3",  "1e300", "(",    ")",   ",",
    "+",    "-",     "*",     "/",      "^",      "<",     "<=",    ">",     ">=",   "==",  "!=",
    "&&",   "||",    "?",     ":",      "abs(",   "sign(", "rint(", "sqrt(", "exp(", "ln(", "log2(",
    "sin(", "asin(", "tanh(", "acosh(", "atan2(", "min(",  "max(",  "sum(",  "avg(", " ",   "_pi"};

std::string expression_of(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || data[0] % 2 == 0) return std::string(fuzz::text_of(data, size));
  std::string text;
  for (std::size_t n = 1; n < size; ++n) text += words[data[n] % std::size(words)];
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse<std::invalid_argument>([&] {
    Expression::Options options;
    options.expression = expression_of(data, size);
    options.total = Vec3{1, 0, 0};
    const Expression expression(options);
    for (const double time : {0.0, 1e-6, 2.0, 1e30}) expression.factor(time);
  });
  return 0;
}
