// A series of files for ParaView: one VTK unstructured grid per frame, in which each particle is a
// vertex, and a collection file (.pvd) that gives the times. Arrays are appended as raw binary
// data. What does not change between frames is encoded once.
#include "encoded_array.hpp"

#include <hyperlattice/frames.hpp>

#include <bit>
#include <numeric>

namespace hyperlattice {
namespace {

using namespace vtu;

enum class Digits : std::uint32_t { single_precision, double_precision };
constexpr std::string_view precisions[] = {"single", "double"};
constexpr OldValue compressions[] = {{"true", "\"zlib\""}, {"false", "\"none\""}};

/// The arrays at the end of a file, in their order.
class Appended {
 public:
  /// Adds an array and returns the text with which an element refers to it.
  std::string add(const EncodedArray& array) {
    std::string text = " format=\"appended\" offset=\"" + std::to_string(size_) + "\"/>\n";
    arrays_.push_back(&array);
    size_ += array.size();
    return text;
  }
  void write(AtomicFile& file) const {
    for (const EncodedArray* array : arrays_) array->write(file);
  }

 private:
  std::vector<const EncodedArray*> arrays_;
  std::size_t size_ = 0;
};

class Vtu {
 public:
  struct Options : FrameOptions {
    Codec codec = Codec::lz4;
    Digits precision = Digits::single_precision;
  };

  static Schema<Options> schema() {
    Schema<Options> schema(
        "writers.vtu",
        "Series of VTK unstructured grids for ParaView, with a .pvd file that gives the times");
    add_frame_options(schema);
    schema
        .add<&Options::codec>("codec", "",
                              "how arrays are packed; lz4: almost as fast as none; zlib: the "
                              "smallest files, and by far the most time")
        .choices(codecs)
        .fallback("\"lz4\"")
        .formerly("compress", "0.2", compressions)
        .add<&Options::precision>("precision", "",
                                  "of the numbers in the files: single has 7 digits, double has "
                                  "all 16 and takes twice the space")
        .choices(precisions)
        .fallback("\"single\"");
    return schema.check(check_frame_options<Options>);
  }

  explicit Vtu(const Options& options) : options_(options), fields_(options.fields.size()) {}

  void begin(const OutputContext& context) {
    require_fields(context, options_);
    files_ = FrameFiles(context, options_.file, ".vtu");
    selection_ = Selection(context.particles(options_.region));
    for (std::size_t n = 0; n < context.earlier.size(); ++n)
      add_to_collection(files_.name(n), context.earlier[n].time);
  }

  void frame(const Snapshot& snapshot) {
    encode(snapshot);
    Appended appended;
    const std::string xml = description(appended);
    AtomicFile file(files_.path());
    file.write(xml);
    appended.write(file);
    file.write("\n</AppendedData>\n</VTKFile>\n");
    file.commit();
    add_to_collection(files_.name(), snapshot.time);
    write_collection();
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
    if (options_.precision == Digits::single_precision)
      array.encode<float>(snapshot, options_.codec, values);
    else
      array.encode<double>(snapshot, options_.codec, values);
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

  /// Returns the text before the appended arrays.
  std::string description(Appended& appended) const {
    const std::string_view real = options_.precision == Digits::single_precision ? "Float32"
                                                                                 : "Float64",
                           whole = has_long_numbers() ? "Int64" : "Int32",
                           compressor = compressor_of(options_.codec);
    std::string xml =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
    xml += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    xml += "\" header_type=\"UInt64\"";
    if (!compressor.empty()) xml.append(" compressor=\"").append(compressor).append("\"");
    xml += ">\n<UnstructuredGrid>\n<FieldData>\n";
    xml += data_array("Float64", "TimeValue", " NumberOfTuples=\"1\"") + appended.add(time_) +
           "</FieldData>\n";
    const std::string count = std::to_string(selection_.size());
    xml +=
        "<Piece NumberOfPoints=\"" + count + "\" NumberOfCells=\"" + count + "\">\n<PointData>\n";
    for (std::size_t n = 0; n < fields_.size(); ++n)
      xml += data_array(real, options_.fields[n],
                        shape_of(options_.fields[n], fields_[n].components)) +
             appended.add(fields_[n].array);
    xml += "</PointData>\n<Points>\n" + data_array(real, "Points", components(3)) +
           appended.add(points_) + "</Points>\n<Cells>\n";
    xml += data_array(whole, "connectivity", "") + appended.add(connectivity_);
    xml += data_array(whole, "offsets", "") + appended.add(offsets_);
    xml += data_array("UInt8", "types", "") + appended.add(types_);
    return xml + "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  }

  static std::string components(std::uint32_t count) {
    return " NumberOfComponents=\"" + std::to_string(count) + "\"";
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

  static std::string data_array(std::string_view type, std::string_view name,
                                std::string_view shape) {
    std::string text = "<DataArray type=\"";
    return text.append(type).append("\" Name=\"").append(name).append("\"").append(shape);
  }

  void add_to_collection(const std::string& file, double time) {
    collection_ += "<DataSet timestep=\"";
    append_number(collection_, time);
    collection_ += "\" part=\"0\" file=\"" + file + "\"/>\n";
  }

  /// Writes the collection file, with every frame, so that an interrupted run can be opened.
  void write_collection() const {
    write_file(
        files_.path_of_series(".pvd"),
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" +
            collection_ + "</Collection>\n</VTKFile>\n");
  }

  struct EncodedField {
    std::uint32_t components = 0;
    EncodedArray array;
  };

  Options options_;
  FrameFiles files_;
  Selection selection_;
  std::string collection_;
  EncodedArray time_, points_, connectivity_, offsets_, types_;
  std::vector<EncodedField> fields_;  ///< in the order of the option
  std::vector<double> buffer_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Vtu>(); }
