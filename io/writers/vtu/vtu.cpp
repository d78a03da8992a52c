// A series of files for ParaView: one VTK unstructured grid per frame, in which each particle is a
// vertex, and a collection file (.pvd) that gives the times. Arrays are appended as raw binary
// data, optionally compressed block by block; sizes are unsigned 64-bit numbers:
//   uncompressed: number of bytes; data
//   compressed:   number of blocks, bytes of a block, bytes of the last block if it is shorter
//                 (else 0), compressed bytes of each block; then the blocks
#include <hyperlattice/frames.hpp>

#include <zlib.h>
#include <bit>
#include <cstring>
#include <numeric>

namespace hyperlattice {
namespace {

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

void append_sizes(std::string& out, std::span<const std::uint64_t> sizes) {
  out.append(bytes_of(sizes));
}

void append_compressed(std::string& out, std::string_view data) {
  constexpr std::size_t block_size =
      1 << 18;  // larger than zlib's window, small enough to be unpacked block by block
  const std::size_t blocks = (data.size() + block_size - 1) / block_size;
  std::vector<std::uint64_t> sizes{blocks, block_size, data.size() % block_size};
  std::vector<Bytef> packed(compressBound(block_size));
  std::string body;
  for (std::size_t start = 0; start < data.size(); start += block_size) {
    const std::string_view block = data.substr(start, block_size);
    uLongf size = packed.size();
    if (compress2(packed.data(), &size, reinterpret_cast<const Bytef*>(block.data()), block.size(),
                  Z_BEST_SPEED) != Z_OK)
      throw std::runtime_error("zlib cannot compress a block");
    sizes.push_back(size);
    body.append(reinterpret_cast<const char*>(packed.data()), size);
  }
  append_sizes(out, sizes);
  out += body;
}

class Vtu {
 public:
  struct Options : FrameOptions {
    bool compress = true;
  };

  static Schema<Options> schema() {
    Schema<Options> schema(
        "writers.vtu",
        "Series of VTK unstructured grids for ParaView, with a .pvd file that gives the times");
    add_frame_options(schema);
    schema.add<&Options::compress>("compress", "", "compress with zlib").fallback("true");
    return schema.check(check_frame_options<Options>);
  }

  explicit Vtu(const Options& options) : options_(options) {}

  void begin(const OutputContext& context) {
    for (const std::string& name : options_.fields) require_field(context, name);
    files_ = FrameFiles(context, options_.file, ".vtu");
    selection_ = Selection(context.particles(options_.region));
    for (std::size_t n = 0; n < context.earlier.size(); ++n)
      add_to_collection(files_.name(n), context.earlier[n].time);
  }

  void frame(const Snapshot& snapshot) {
    std::string appended = encoded_cells();
    const std::size_t points = append(
        appended, bytes_of(selection_.positions(snapshot, options_.deformed ? 1 : 0, buffer_)));
    const std::size_t time = append(appended, bytes_of(std::span(&snapshot.time, 1)));

    std::string xml =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
    xml += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    xml += "\" header_type=\"UInt64\"";
    if (options_.compress) xml += " compressor=\"vtkZLibDataCompressor\"";
    xml += ">\n<UnstructuredGrid>\n<FieldData>\n";
    xml += data_array("Float64", "TimeValue", "NumberOfTuples=\"1\"", time) + "</FieldData>\n";
    const std::string count = std::to_string(selection_.size());
    xml +=
        "<Piece NumberOfPoints=\"" + count + "\" NumberOfCells=\"" + count + "\">\n<PointData>\n";
    for (const std::string& name : options_.fields) {
      const Field field = require_field(snapshot, name);
      const std::size_t offset =
          append(appended, bytes_of(selection_.of(field.values, field.components, buffer_)));
      xml += data_array("Float64", name, shape_of(name, field.components), offset);
    }
    xml += "</PointData>\n<Points>\n" + data_array("Float64", "Points", components(3), points) +
           "</Points>\n<Cells>\n";
    xml += data_array("Int64", "connectivity", "", 0) +
           data_array("Int64", "offsets", "", cell_offsets_);
    xml += data_array("UInt8", "types", "", cell_types_) +
           "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

    AtomicFile file(files_.path());
    file.write(xml);
    file.write(appended);
    file.write("\n</AppendedData>\n</VTKFile>\n");
    file.commit();
    add_to_collection(files_.name(), snapshot.time);
    write_collection();
    files_.next();
  }

  void end() {}

 private:
  static std::string components(std::uint32_t count) {
    return "NumberOfComponents=\"" + std::to_string(count) + "\"";
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
                                std::string_view shape, std::size_t offset) {
    std::string text = "<DataArray type=\"";
    text.append(type).append("\" Name=\"").append(name).append("\" ").append(shape);
    return text + " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
  }

  /// Appends an array to `out` and returns its offset, bytes.
  std::size_t append(std::string& out, std::string_view data) const {
    const std::size_t offset = out.size();
    if (options_.compress) {
      append_compressed(out, data);
    } else {
      const std::uint64_t size = data.size();
      append_sizes(out, std::span(&size, 1));
      out += data;
    }
    return offset;
  }

  /// Returns the encoded cells: cell n is a vertex at point n, with connectivity 0, 1, ... and
  /// offsets 1, 2, ... They are the same in every frame and are encoded once.
  const std::string& encoded_cells() {
    if (!cells_.empty()) return cells_;
    std::vector<std::int64_t> numbers(selection_.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    append(cells_, bytes_of<std::int64_t>(numbers));
    std::iota(numbers.begin(), numbers.end(), 1);
    cell_offsets_ = append(cells_, bytes_of<std::int64_t>(numbers));
    constexpr std::uint8_t vertex = 1;  // VTK_VERTEX
    const std::vector<std::uint8_t> types(selection_.size(), vertex);
    cell_types_ = append(cells_, bytes_of<std::uint8_t>(types));
    return cells_;
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

  Options options_;
  FrameFiles files_;
  Selection selection_;
  std::string cells_, collection_;
  std::size_t cell_offsets_ = 0, cell_types_ = 0;
  std::vector<double> buffer_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Vtu>(); }
