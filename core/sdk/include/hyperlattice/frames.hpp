// Common parts of writers with one file per frame: options for particles and fields, and file
// names.
//
//   struct Options : FrameOptions { bool compact; };
//   static Schema<Options> schema() {
//     ... add_frame_options(schema); schema.check(check_frame_options<Options>); ...
//   }
#pragma once

#include <hyperlattice/fields.hpp>
#include <hyperlattice/files.hpp>

#include <algorithm>

namespace hyperlattice {

/// Options that writers of frames share: fields, name of the files, region, and times in s.
struct FrameOptions {
  std::vector<std::string> fields;
  std::string file;
  RegionId region;
  bool deformed = false;
};

/// Declares the options above.
template <class Options>
void add_frame_options(Schema<Options>& schema) {
  schema.template add<&Options::fields>("fields", "", "fields to write")
      .choices(field_names)
      .plugin_fields()
      .fallback(R"(["displacement", "velocity"])")
      .template add<&Options::file>("file", "", "base name of the files")
      .fallback("\"frames\"")
      .template add<&Options::region>("region", "", "particles to write")
      .fallback("\"all\"")
      .template add<&Options::deformed>("deformed", "",
                                        "points at their displaced positions, not those at rest")
      .fallback("false");
}

/// Checks a base name. It becomes part of file names and of XML, so only plain characters are
/// allowed.
inline void check_file_name(const std::string& file, const FaultSink& faults) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  constexpr std::size_t longest = 80;
  if (file.empty() || file.size() > longest || file.front() == '.' ||
      !std::all_of(file.begin(), file.end(), plain))
    faults.fault(
        "file",
        "a name of letters, digits, '_', '-' and '.', without folders, of at most 80 characters");
}

/// Checks the options above against each other.
template <class Options>
void check_frame_options(const Options& options, const FaultSink& faults) {
  check_file_name(options.file, faults);
  for (auto name = options.fields.begin(); name != options.fields.end(); ++name)
    if (std::find(options.fields.begin(), name, *name) != name)
      faults.fault("fields", "each field once; \"" + *name + "\" is there twice");
}

/// Names the fields of these options to the run. Throws std::runtime_error if the run lacks one.
/// For begin().
inline void require_fields(const OutputContext& context, const FrameOptions& options) {
  for (const std::string& name : options.fields) require_field(context, name);
  if (options.deformed) require_field(context, "displacement");
}

/// The numbered files of one writer: `<directory>/<file>_000000<extension>` and so on. A caller
/// that asks for a path is about to write the file, so the path is announced to the run.
class FrameFiles {
 public:
  FrameFiles() = default;
  FrameFiles(const OutputContext& context, std::string_view file, std::string_view extension)
      : base_(std::string(context.directory) + "/"),
        file_(file),
        extension_(extension),
        frame_(context.earlier.size()),
        run_(context.self),
        announce_(context.announce_file) {}

  /// Returns the file name of the present frame, without its folder.
  std::string name() const { return name(frame_); }
  std::string name(std::uint64_t frame) const {
    std::string number = std::to_string(frame);
    if (number.size() < 6) number.insert(0, 6 - number.size(), '0');
    return file_ + "_" + number + extension_;
  }
  std::string path() const { return announced(name(), false); }
  /// Returns the path of a file of the whole series, which is rewritten with each frame:
  /// `<directory>/<file><suffix>`.
  std::string path_of_series(std::string_view suffix) const {
    return announced(file_ + std::string(suffix), true);
  }
  /// Goes on to the next frame.
  void next() { ++frame_; }

 private:
  std::string announced(const std::string& name, bool rewritten) const {
    if (announce_ != nullptr && !announce_(run_, name, rewritten))
      throw std::runtime_error(name + " is not a file of this run");
    return base_ + name;
  }

  std::string base_, file_, extension_;
  std::uint64_t frame_ = 0;
  void* run_ = nullptr;
  bool (*announce_)(void* run, std::string_view name, bool rewritten) noexcept = nullptr;
};

/// The particles of a region, and their values of any field. A region of consecutive particles,
/// such as the whole body, needs no copies.
class Selection {
 public:
  Selection() = default;
  explicit Selection(std::span<const Particle> particles) : size_(particles.size()) {
    if (particles.empty()) throw std::runtime_error("no particle lies in the region");
    first_ = particles.front();
    if (particles.back() - first_ + 1 != size_)
      scattered_.assign(particles.begin(), particles.end());
  }

  std::size_t size() const { return size_; }
  Particle operator[](std::size_t n) const {
    return scattered_.empty() ? first_ + n : scattered_[n];
  }

  /// Returns the values of the selected particles; copied into `buffer` if they are not
  /// consecutive.
  std::span<const double> of(std::span<const double> values, std::size_t components,
                             std::vector<double>& buffer) const {
    if (scattered_.empty()) return values.subspan(first_ * components, size_ * components);
    buffer.resize(size_ * components);
    for (std::size_t n = 0; n < size_; ++n)
      std::copy_n(&values[scattered_[n] * components], components, &buffer[n * components]);
    return buffer;
  }

  /// Returns positions at rest plus `magnification` times displacements, m; in `buffer` if they had
  /// to be computed or copied.
  std::span<const double> positions(const Snapshot& snapshot, double magnification,
                                    std::vector<double>& buffer) const {
    if (magnification == 0) return of(snapshot.positions, 3, buffer);
    const auto displacement = require_field(snapshot, "displacement").values;
    buffer.resize(3 * size_);
    for (std::size_t n = 0; n < size_; ++n)
      for (std::size_t axis = 0; axis < 3; ++axis)
        buffer[3 * n + axis] = snapshot.positions[3 * (*this)[n] + axis] +
                               magnification * displacement[3 * (*this)[n] + axis];
    return buffer;
  }

 private:
  std::size_t size_ = 0;
  Particle first_ = 0;
  std::vector<Particle> scattered_;
};

}  // namespace hyperlattice
