// Checkpoints. The first byte chooses what the run resumes from: the input as the whole file; a
// sound file with changed bytes, which must be refused; or a file with sound checksums whose head
// is changed and whose state is shorter or longer. The numbers of a state behind sound checksums
// are the program's own, so that they are not changed.
#include "target.hpp"

#include <fuzzer/FuzzedDataProvider.h>
#include <run/records.hpp>
#include <run/stage_sequence.hpp>

using namespace hyperlattice;

namespace {

constexpr const char* scene = R"({ "format": "hyperlattice/1", "pipeline": [
  { "type": "lattices.cubic", "spacing": 1, "shape": { "box": { "low": [0, 0, 0], "high": [2, 2, 2] } } },
  { "type": "materials.elastic", "young": 1e9, "poisson": 0.1, "density": 1000, "membrane": "I-m",
    "failure": { "type": "failures.elongation", "limit": 1e-5 } },
  { "type": "loads.velocity", "on": "z_max", "value": [0, 0, 1] },
  { "type": "solvers.explicit", "end_time": 1e-2 },
  { "type": "probes.point", "position": [0.5, 0.5, 1.5] },
  { "type": "writers.csv" } ] })";

/// A run in its folder, and a sound checkpoint of it.
class SmallRun {
 public:
  SmallRun()
      : plan_(make_plan(read_scene_text(scene, host_), 1)), run_folder_(folder_.file("out"), true) {
    run_folder_.begin(true, {});
    options_.directory = folder_.file("out");
    Simulation simulation(*plan_->model, 1);
    for (int n = 0; n < 20; ++n) simulation.step(1e-5);
    StageSequence stages(*plan_, options_, run_folder_, simulation);
    write_checkpoint(options_.directory, checkpoint_head(*plan_, false),
                     [&](Archive& archive) { stages.archive(archive); });
    RecordReader records(options_.directory / checkpoint_file);
    head_ = records.take_all("head");
    state_ = records.take_all("stat");
    std::ifstream file(options_.directory / checkpoint_file, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  const std::string& head() const { return head_; }
  const std::string& state() const { return state_; }
  const std::string& bytes() const { return bytes_; }

  void write(std::string_view bytes) const { folder_.write("out/checkpoint.bin", bytes); }
  void write(std::string_view head, std::string_view state) const {
    AtomicFile file((options_.directory / checkpoint_file).string());
    RecordWriter records(file);
    records.put("head", head.data(), head.size());
    records.put("stat", state.data(), state.size());
    records.end();
    file.commit();
  }
  void resume() {
    const Checkpoint checkpoint = find_checkpoint(*plan_, options_.directory);
    Simulation simulation(*plan_->model, 1);
    StageSequence stages(*plan_, options_, run_folder_, simulation);
    read_checkpoint(checkpoint, [&](Archive& archive) { stages.archive(archive); });
  }

 private:
  fuzz::Folder folder_;
  Host host_;
  std::unique_ptr<Plan> plan_;
  RunOptions options_;
  RunFolder run_folder_;
  std::string head_, state_, bytes_;
};

/// Overwrites, removes and inserts bytes, as the input says.
std::string changed(std::string bytes, FuzzedDataProvider& input) {
  for (auto changes = input.ConsumeIntegralInRange(0, 4); changes > 0 && !bytes.empty();
       --changes) {
    const auto at = input.ConsumeIntegralInRange<std::size_t>(0, bytes.size() - 1);
    const std::string piece = input.ConsumeRandomLengthString(16);
    bytes.replace(
        at, input.ConsumeBool() ? piece.size() : input.ConsumeIntegralInRange<std::size_t>(0, 64),
        piece);
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static SmallRun run;
  FuzzedDataProvider input(data, size);
  bool may_be_accepted = true;
  switch (input.ConsumeIntegralInRange(0, 2)) {
    case 0:
      run.write(input.ConsumeRemainingBytesAsString());
      break;
    case 1: {
      const std::string bytes = changed(run.bytes(), input);
      may_be_accepted = bytes == run.bytes();
      run.write(bytes);
      break;
    }
    default: {
      std::string state = run.state();
      if (input.ConsumeBool())
        state.resize(input.ConsumeIntegralInRange<std::size_t>(0, 2 * state.size()));
      run.write(changed(run.head(), input), state);
    }
  }
  fuzz::read_or_refuse<std::runtime_error>([&] {
    run.resume();
    fuzz::require(may_be_accepted);
  });
  return 0;
}
