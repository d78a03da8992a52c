#include "machine.hpp"

#include <base/input_file.hpp>
#include <scene/json.hpp>
#include <study/object_reader.hpp>

namespace hyperlattice {

namespace {

struct MachineFile {
  struct Options {
    double latency = 2e-6, bandwidth = 2e10;
    std::optional<double> memory;
  };
  static Schema<Options> schema() {
    return Schema<Options>("machine", "What connects the ranks of a run")
        .add<&Options::latency>("latency", "s", "time of a short message")
        .at_least(0)
        .fallback("\"2 us\"")
        .add<&Options::bandwidth>("bandwidth", "", "of the messages of a rank, bytes/s")
        .positive()
        .fallback("2e10")
        .add<&Options::memory>("memory", "", "of a rank, bytes")
        .positive();
  }
};

}  // namespace

Machine read_machine(const std::filesystem::path& file) {
  if (file.empty()) return {};
  Faults faults;
  Json object;
  if (!parse_json(read_input_file(file, "--machine", "the path of a JSON file"), object, faults))
    faults.throw_if_any();
  const auto options = study::ObjectReader(faults).read<MachineFile>(object, "");
  faults.throw_if_any();
  return {options->latency, options->bandwidth, options->memory};
}

}  // namespace hyperlattice
