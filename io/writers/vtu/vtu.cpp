// A series of files for ParaView: one VTK unstructured grid per frame, in which each particle is a
// vertex, and a collection file (.pvd) that gives the times. Arrays are appended as raw binary
// data. What does not change between frames is encoded once.
#include <vtk/xml_file.hpp>

#include <hyperlattice/frames.hpp>

#include <numeric>

namespace hyperlattice {
namespace {

using namespace vtk;

constexpr OldValue compressions[] = {{"true", "\"zlib\""}, {"false", "\"none\""}};

class Vtu {
 public:
  struct Options : FrameOptions, PackingOptions {};

  static Schema<Options> schema() {
    Schema<Options> schema(
        "writers.vtu",
        "Series of VTK unstructured grids for ParaView, with a .pvd file that gives the times");
    add_frame_options(schema);
    add_codec_option(schema).formerly("compress", "0.2", compressions);
    add_precision_option(schema);
    return schema.check(check_frame_options<Options>);
  }

  explicit Vtu(const Options& options) : options_(options), fields_(options.fields.size()) {}

  void begin(const OutputContext& context) {
    require_fields(context, options_);
    files_ = FrameFiles(context, options_.file, ".vtu");
    selection_ = Selection(context.particles(options_.region));
    for (std::size_t n = 0; n < context.earlier.size(); ++n)
      collection_.add(files_.name(n), context.earlier[n].time);
  }

  void frame(const Snapshot& snapshot) {
    encode(snapshot);
    describe().write(files_.path());
    collection_.add(files_.name(), snapshot.time);
    // With every frame, so that an interrupted run can be opened.
    collection_.write(files_.path_of_series(".pvd"));
    files_.next();
  }

  void end() {}

  /// Returns the bytes of the encoded arrays, and of displaced points before they are encoded.
  double memory_bytes() const noexcept {
    double numbers = 3;
    for (const std::string& name : options_.fields) {
      const FieldInfo* field = find_field(name);
      numbers += field == nullptr ? 1 : components_of(*field);
    }
    const std::size_t real =
        options_.precision == Digits::single_precision ? sizeof(float) : sizeof(double);
    const std::size_t index = has_long_numbers() ? sizeof(std::int64_t) : sizeof(std::int32_t);
    const std::size_t cell = 2 * index + sizeof(std::uint8_t);
    const std::size_t moved = options_.deformed ? 3 * sizeof(double) : 0;
    return static_cast<double>(selection_.size()) *
           (numbers * static_cast<double>(real) + static_cast<double>(cell + moved));
  }

 private:
  void encode(const Snapshot& snapshot) {
    if (types_.empty()) encode_cells(snapshot);
    if (points_.empty() || options_.deformed)
      encode(snapshot, selection_.positions(snapshot, options_.deformed ? 1 : 0, buffer_), points_);
    time_.encode<double>(snapshot, options_.codec, std::span(&snapshot.time, 1));
    for (std::size_t n = 0; n < fields_.size(); ++n) {
      const std::string& name = options_.fields[n];
      if (!fields_[n].array.empty() && is_constant_field(name)) continue;
      const Field field = require_field(snapshot, name);
      fields_[n].components = field.components;
      encode(snapshot, selection_.of(field.values, field.components, buffer_), fields_[n].array);
    }
  }

  void encode(const Snapshot& snapshot, std::span<const double> values, EncodedArray& array) const {
    vtk::encode(snapshot, options_, values, array);
  }

  /// Encodes the cells: cell n is a vertex at point n, with connectivity 0, 1, ... and offsets 1,
  /// 2, ...
  void encode_cells(const Snapshot& snapshot) {
    std::vector<std::int64_t> numbers(selection_.size());
    const auto encode_from = [&](std::int64_t first, EncodedArray& array) {
      std::iota(numbers.begin(), numbers.end(), first);
      const std::span<const std::int64_t> all = numbers;
      if (has_long_numbers())
        array.encode<std::int64_t>(snapshot, options_.codec, all);
      else
        array.encode<std::int32_t>(snapshot, options_.codec, all);
    };
    encode_from(0, connectivity_);
    encode_from(1, offsets_);
    constexpr std::uint8_t vertex = 1;  // VTK_VERTEX
    const std::vector<std::uint8_t> types(selection_.size(), vertex);
    types_.encode<std::uint8_t>(snapshot, options_.codec, std::span(types));
  }

  bool has_long_numbers() const {
    return selection_.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  }

  XmlFile describe() const {
    const std::string_view real = real_type(options_.precision),
                           whole = has_long_numbers() ? "Int64" : "Int32";
    XmlFile file("UnstructuredGrid", options_.codec);
    file << "<FieldData>\n";
    file.add("Float64", "TimeValue", " NumberOfTuples=\"1\"", time_);
    const std::string count = std::to_string(selection_.size());
    file << "</FieldData>\n<Piece NumberOfPoints=\"" << count << "\" NumberOfCells=\"" << count
         << "\">\n<PointData>\n";
    for (std::size_t n = 0; n < fields_.size(); ++n)
      file.add(real, options_.fields[n], shape_of(options_.fields[n], fields_[n].components),
               fields_[n].array);
    file << "</PointData>\n<Points>\n";
    file.add(real, "Points", components(3), points_);
    file << "</Points>\n<Cells>\n";
    file.add(whole, "connectivity", "", connectivity_);
    file.add(whole, "offsets", "", offsets_);
    file.add("UInt8", "types", "", types_);
    file << "</Cells>\n</Piece>\n";
    return file;
  }

  /// Returns the number and the names of a field's components, which ParaView shows.
  static std::string shape_of(const std::string& name, std::uint32_t count) {
    std::string text = components(count);
    const FieldInfo* field = find_field(name);
    if (field == nullptr || components_of(*field) != count || count == 1) return text;
    for (std::size_t n = 0; n < count; ++n)
      text += " ComponentName" + std::to_string(n) + "=\"" + std::string(parts_of(field->kind)[n]) +
              "\"";
    return text;
  }

  struct EncodedField {
    std::uint32_t components = 0;
    EncodedArray array;
  };

  Options options_;
  FrameFiles files_;
  Selection selection_;
  Collection collection_;
  EncodedArray time_, points_, connectivity_, offsets_, types_;
  std::vector<EncodedField> fields_;  ///< in the order of the option
  std::vector<double> buffer_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Vtu>(); }
