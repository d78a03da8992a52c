// The names of the columns in a probe's table.
#pragma once

#include <host/plugin_call.hpp>

#include <hyperlattice/output.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace hyperlattice {

/// Returns whether any reader of tables can take the name: 1 to 200 printable characters, no comma,
/// quote or line end.
inline bool is_column_name(std::string_view name) {
  constexpr std::size_t longest = 200;
  const auto breaks_table = [](char c) {
    return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  };
  return !name.empty() && name.size() <= longest &&
         std::none_of(name.begin(), name.end(), breaks_table);
}

/// Returns a sink that appends the probe's names to `columns`, which must outlive the sink.
inline ColumnSink columns_into(std::vector<std::string>& columns) {
  return {
      &columns, [](void* self, std::string_view name) noexcept {
        PluginCall::answer([&] {
          if (!is_column_name(name))
            throw PluginMistake("it names a column \"" + std::string(name.substr(0, 40)) +
                                "\"; expected 1 to 200 characters, no comma, quote or line end");
          static_cast<std::vector<std::string>*>(self)->emplace_back(name);
        });
      }};
}

}  // namespace hyperlattice
