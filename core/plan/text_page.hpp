// Pages of figures as text, with sections and aligned names.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <iterator>
#include <string>
#include <string_view>

namespace hyperlattice {

class Page {
 public:
  void section(std::string_view title) {
    fmt::format_to(std::back_inserter(text_), "\n{}\n", title);
  }
  void line(std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "  {:<30} {}\n", name, value);
  }
  std::string take() { return std::move(text_); }
  void title(std::string_view text) { text_ = fmt::format("{}\n", text); }

 private:
  std::string text_;
};

}  // namespace hyperlattice
