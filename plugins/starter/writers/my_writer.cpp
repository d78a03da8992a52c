// One file a frame in the format XYZ, which many programs for particles read: how many there are, a
// line about them, then for each its name, its place and its displacement, in metres.
#include <hyperlattice/frames.hpp>

namespace {
using namespace hyperlattice;

class MyWriter {
 public:
  struct Options {
    std::string file;
  };

  static Schema<Options> schema() {
    return Schema<Options>("writers.my_writer",
                           "One file a frame in the format XYZ: places and displacements")
        .add<&Options::file>("file", "", "base name of the files")
        .fallback("\"particles\"")
        .check([](const Options& options, const FaultSink& faults) {
          check_file_name(options.file, faults);
        });
  }

  explicit MyWriter(const Options& options) : o_(options) {}

  // Writes nothing yet: the plan calls it too. Names the fields of the frames, so that the run goes
  // on while a frame is written.
  void begin(const OutputContext& context) {
    require_field(context, "displacement");
    files_ = FrameFiles(context, o_.file, ".xyz");
  }

  // Fields are computed when they are asked for. A file is written under another name and renamed
  // when it is whole.
  void frame(const Snapshot& snapshot) {
    const Field displacement = require_field(snapshot, "displacement");
    std::string text = std::to_string(snapshot.particles) +
                       "\nProperties=species:S:1:pos:R:3:displacement:R:3 Time=";
    append_number(text, snapshot.time);
    text += '\n';
    for (std::size_t particle = 0; particle < snapshot.particles; ++particle) {
      text += 'P';
      append(text, snapshot.positions.subspan(3 * particle, 3));
      append(text, displacement.values.subspan(3 * particle, 3));
      text += '\n';
    }
    write_file(files_.path(), text);
    files_.next();
  }

  void end() {}

 private:
  static void append(std::string& text, std::span<const double> values) {
    for (const double value : values) {
      text += ' ';
      append_number(text, value);
    }
  }

  Options o_;
  FrameFiles files_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<MyWriter>(); }
