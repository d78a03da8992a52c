#include <base/input_file.hpp>
#include <study/outside_table.hpp>

#include <hyperlattice/tables.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice::study {

CsvTable read_outside_table(const std::filesystem::path& file, const std::string& pointer,
                            const std::string& what, Faults& faults) {
  const std::string text = read_input_file(file, pointer, what), name = file.filename().string();
  if (const std::string fault = table_encoding_fault(text); !fault.empty()) {
    faults.add(pointer, name, what + "; " + fault);
    return {};
  }
  CsvTable table = parse_csv(text);
  for (const CsvFault& fault : table.faults)
    faults.add(pointer, fmt::format("{}, line {}", name, fault.line), fault.expected);
  if (const auto twice = name_of_several(table))
    faults.add(pointer, name, fmt::format("one column \"{}\", not several", *twice));
  return table;
}

}  // namespace hyperlattice::study
