// A writer that hands each frame to a Python function.
#pragma once

#include "function_options.hpp"

#include <hyperlattice/frames.hpp>

#include <numeric>

namespace hyperlattice::python {

class Writer {
 public:
  struct Options : FunctionOptions {
    std::vector<std::string> fields;
    RegionId region;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("writers.python", "Frames that a Python function gets");
    schema
        .restrictions(
            "the function runs beside the next steps, and delays them where both need Python. Only "
            "for scenes that Python runs")
        .add<&Options::fields>("fields", "", "fields that the function gets")
        .choices(field_names)
        .plugin_fields()
        .fallback(R"(["displacement", "velocity"])")
        .add<&Options::region>("region", "", "particles that the function gets")
        .fallback("\"all\"");
    return add_function_options(schema, "gets the frames")
        .check([](const Options& options, const FaultSink& faults) {
          check_function(options, faults);
        });
  }

  explicit Writer(const Options& options) : o_(options), function_(found(options)) {}

  void begin(const OutputContext& context) {
    for (const std::string& name : o_.fields) require_field(context, name);
    selection_ = Selection(context.particles(o_.region));
    particles_.resize(selection_.size());
    for (std::size_t n = 0; n < particles_.size(); ++n) particles_[n] = selection_[n];
    number_ = context.earlier.size();
    directory_ = context.directory;
    run_ = context.self;
    announce_ = context.announce_file;
  }

  void frame(const Snapshot& snapshot) {
    std::vector<std::vector<double>> copies(o_.fields.size() + 1);
    std::vector<FrameField> fields;
    for (const std::string& name : o_.fields) {
      const Field field = require_field(snapshot, name);
      fields.push_back({name, field.components,
                        selection_.of(field.values, field.components, copies[fields.size()])});
    }
    function_->write({snapshot.time, snapshot.step, number_, particles_,
                      selection_.of(snapshot.positions, 3, copies.back()), fields,
                      [this](const std::string& name) { return path_of(name); }});
    ++number_;
  }
  void end() {}

 private:
  std::string path_of(const std::string& name) const {
    if (announce_ != nullptr && !announce_(run_, name, false))
      throw std::runtime_error(name + " is not a file of this run");
    return directory_ + "/" + name;
  }

  Options o_;
  std::shared_ptr<PythonFunction> function_;
  Selection selection_;
  std::vector<Particle> particles_;
  std::uint64_t number_ = 0;
  std::string directory_;
  void* run_ = nullptr;
  bool (*announce_)(void* run, std::string_view name, bool rewritten) noexcept = nullptr;
};

}  // namespace hyperlattice::python
