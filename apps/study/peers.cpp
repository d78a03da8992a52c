#include <base/csv.hpp>
#include <scene/json.hpp>
#include <study/outside_table.hpp>
#include <study/peers.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

namespace hyperlattice::study {

void append_peers(std::vector<Peer>& peers, const std::filesystem::path& file,
                  const std::string& pointer, Faults& faults) {
  CsvTable table;
  try {
    const std::size_t before = faults.size();
    table =
        read_outside_table(file, pointer, "a table with the columns label, error, seconds", faults);
    if (faults.size() > before) return;
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      faults.add(fault.pointer, fault.value, fault.expected);
    return;
  }
  const auto label = table.column("label"), error = table.column("error"),
             seconds = table.column("seconds");
  if (!label || !error || !seconds)
    return faults.add(pointer, file.filename().string(),
                      fmt::format("the columns label, error and seconds; it has {}",
                                  fmt::join(table.columns, ", ")));
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto& cells = table.rows[row];
    const auto e = csv_number(cells[*error]), s = csv_number(cells[*seconds]);
    if (!is_utf8(cells[*label]))
      faults.add(
          pointer,
          fmt::format("{}, row {}: {}", file.filename().string(), row + 1, shown(cells[*label])),
          "a label in UTF-8");
    else if (e && s && *e > 0 && *s > 0)
      peers.push_back({cells[*label], *e, *s});
    else
      faults.add(
          pointer,
          fmt::format("{}, row {}: {}", file.filename().string(), row + 1, fmt::join(cells, ",")),
          "an error and seconds above 0");
  }
}

}  // namespace hyperlattice::study
