// A slow writer whose frames are written beside the steps. It commits the fault named in the
// environment, in a frame between 2.2 us and 10 us (that of the trial is later); see fault.hpp.
#include "fault.hpp"

#include <hyperlattice/frames.hpp>

#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>

namespace {
using namespace hyperlattice;

class Misbehaves {
 public:
  struct Options {
    std::string file;
  };
  static Schema<Options> schema() {
    return Schema<Options>("writers.misbehaving", "Misbehaves")
        .add<&Options::file>("file", "", "base name of the files")
        .fallback("\"sum\"");
  }
  explicit Misbehaves(const Options& options) : options_(options) {}

  void begin(const OutputContext& context) {
    require_field(context, "displacement");
    files_ = FrameFiles(context, options_.file, ".txt");
    begun_on_ = std::this_thread::get_id();
  }

  void frame(const Snapshot& snapshot) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    if (snapshot.time > 2.2e-6 && snapshot.time < 1e-5) misbehave(snapshot);
    double sum = 0;
    for (const double value : require_field(snapshot, "displacement").values) sum += value;
    std::string text = std::this_thread::get_id() == begun_on_ ? "same thread " : "other thread ";
    append_number(text, sum);
    write_file(files_.path(), text);
    files_.next();
  }

  void end() {}

 private:
  static void misbehave(const Snapshot& snapshot) {
    if (asked_for("throw in frame")) throw std::runtime_error("oops");
    if (asked_for("no memory in frame")) throw std::bad_alloc();
    if (asked_for("another field")) require_field(snapshot, "velocity");
    if (asked_for("null pointer in task"))
      snapshot.for_each(64, [](std::uint64_t n) {
        if (n == 60) *static_cast<volatile double*>(nullptr) = 1;
      });
    if (asked_for("throw in tasks"))
      snapshot.for_each(64, [](std::uint64_t n) {
        if (n > 40) throw std::runtime_error("oops in " + std::to_string(n));
      });
  }

  Options options_;
  FrameFiles files_;
  std::thread::id begun_on_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Misbehaves>(); }
