// One CSV table per frame: x, y, z and the chosen fields of each particle. Numbers have as many
// digits as needed to read them back exactly. `<file>_times.csv` gives the step and time of each
// table.
#include <hyperlattice/frames.hpp>

namespace hyperlattice {
namespace {

class Csv {
 public:
  using Options = FrameOptions;

  static Schema<Options> schema() {
    Schema<Options> schema(
        "writers.csv",
        "One table of comma-separated values a frame: x, y, z and fields of each particle");
    add_frame_options(schema);
    return schema.check(check_frame_options<Options>);
  }

  explicit Csv(const Options& options) : options_(options) {}

  void begin(const OutputContext& context) {
    require_fields(context, options_);
    files_ = FrameFiles(context, options_.file, ".csv");
    selection_ = Selection(context.particles(options_.region));
    for (std::size_t n = 0; n < context.earlier.size(); ++n)
      add_to_times(files_.name(n), context.earlier[n].step, context.earlier[n].time);
  }

  void frame(const Snapshot& snapshot) {
    std::vector<double> buffer;
    const auto positions = selection_.positions(snapshot, options_.deformed ? 1 : 0, buffer);
    std::string text = "x,y,z";
    std::vector<Field> fields;
    for (const std::string& name : options_.fields) {
      fields.push_back(require_field(snapshot, name));
      const Quantity all({name, std::nullopt, {}});
      for (const std::string& column : all.names()) text += "," + column;
    }
    text += '\n';

    AtomicFile file(files_.path());
    for (std::size_t n = 0; n < selection_.size(); ++n) {
      append_row(text, positions.subspan(3 * n, 3));
      for (const Field& field : fields) {
        text += ',';
        append_row(text, field.values.subspan(selection_[n] * field.components, field.components));
      }
      text += '\n';
      if (text.size() > 1 << 20) {
        file.write(text);
        text.clear();
      }
    }
    file.write(text);
    file.commit();
    add_to_times(files_.name(), snapshot.step, snapshot.time);
    write_file(files_.path_of_series("_times.csv"), times_);
    files_.next();
  }

  void end() {}

 private:
  static void append_row(std::string& text, std::span<const double> values) {
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (n > 0) text += ',';
      append_number(text, values[n]);
    }
  }

  void add_to_times(const std::string& file, std::uint64_t step, double time) {
    times_ += file + "," + std::to_string(step) + ",";
    append_number(times_, time);
    times_ += '\n';
  }

  Options options_;
  FrameFiles files_;
  Selection selection_;
  std::string times_ = "file,step,time\n";
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Csv>(); }
