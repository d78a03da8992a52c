// A writer without any care: its files have their final names from the start, and it does not
// notice a full disk.
#include <hyperlattice/output.hpp>

#include <fstream>
#include <string>

namespace {
using namespace hyperlattice;

class Careless {
 public:
  struct Options {};
  static Schema<Options> schema() { return {"writers.careless", "Writes, whatever becomes of it"}; }
  explicit Careless(const Options&) {}
  void begin(const OutputContext& context) { directory_ = context.directory; }
  void frame(const Snapshot& snapshot) {
    std::ofstream(directory_ + "/frame_" + std::to_string(snapshot.step))
        << std::string(snapshot.particles, '.');
  }
  void end() {}

 private:
  std::string directory_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Careless>(); }
