// Study files, with the grid of their runs. A form feed separates the study from table.csv, to
// which it may refer.
#include "target.hpp"

#include <base/errors.hpp>
#include <study/grid.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hyperlattice;
  static const fuzz::Folder folder;
  std::string_view table;
  const std::string_view study = fuzz::first_file(fuzz::text_of(data, size), table);
  folder.write("table.csv", table);
  const std::string file = folder.write("study.json", study);
  fuzz::read_or_refuse<InputError>([&] { study::grid(study::read_study(file, {})); });
  return 0;
}
