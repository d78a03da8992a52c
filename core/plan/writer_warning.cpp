#include <base/visible.hpp>
#include <plan/writer_warning.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

std::string writer_warning(const Stage& writer, std::string_view sentence) {
  constexpr std::size_t longest = 4096;
  return fmt::format("{} ({}): {}", writer.name, writer.pointer, visible_line(sentence, longest));
}

}  // namespace hyperlattice
