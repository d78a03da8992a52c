// Expressions of time of loads.expression: each is refused when it is read, or evaluated at some
// times.
#include "../../plugins/loads/expression/expression.cpp"

#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse<std::invalid_argument>([&] {
    Expression::Options options;
    options.expression = fuzz::text_of(data, size);
    options.total = Vec3{1, 0, 0};
    const Expression expression(options);
    for (const double time : {0.0, 1e-6, 2.0, 1e30}) expression.factor(time);
  });
  return 0;
}
