#include <base/csv.hpp>
#include <report/vtu_file.hpp>
#include <vtk/codec.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <span>
#include <stdexcept>

namespace hyperlattice::report {

namespace {

/// Returns a whole number that an attribute holds, at most `most`.
std::size_t count_in(std::string_view tag, std::string_view name, std::size_t most) {
  const auto number = csv_number(attribute(tag, name).value_or(""));
  if (!number || *number < 0 || *number > static_cast<double>(most))
    throw std::runtime_error(fmt::format("a {} from 0 to {}", name, most));
  return static_cast<std::size_t>(*number);
}

/// The part of a file that holds the arrays.
class Arrays {
 public:
  Arrays(std::string_view head, std::string_view data) : data_(data) {
    const auto file = tags(head, "VTKFile");
    const bool is_little = std::endian::native == std::endian::little;
    if (file.empty() || attribute(file.front(), "header_type") != "UInt64" ||
        attribute(file.front(), "byte_order") != (is_little ? "LittleEndian" : "BigEndian"))
      throw std::runtime_error("a frame with sizes of 64 bits and the byte order of this machine");
    const std::string compressor = attribute(file.front(), "compressor").value_or("");
    for (const vtk::Codec codec : {vtk::Codec::zlib, vtk::Codec::lz4, vtk::Codec::none})
      if (vtk::compressor_of(codec) == compressor) {
        codec_ = codec;
        return;
      }
    throw std::runtime_error("arrays packed with zlib or lz4");
  }

  /// Returns the numbers of the array that a tag describes.
  std::vector<double> read(std::string_view tag, std::size_t count) const {
    const std::string type = attribute(tag, "type").value_or("");
    if (type != "Float32" && type != "Float64") throw std::runtime_error("arrays of real numbers");
    const std::size_t size = type == "Float32" ? sizeof(float) : sizeof(double);
    const std::string bytes = unpacked(count_in(tag, "offset", data_.size()), count * size);
    std::vector<double> numbers(count);
    for (std::size_t n = 0; n < count; ++n) {
      if (size == sizeof(double)) {
        std::memcpy(&numbers[n], &bytes[n * size], size);
      } else {
        float number = 0;
        std::memcpy(&number, &bytes[n * size], size);
        numbers[n] = static_cast<double>(number);
      }
    }
    return numbers;
  }

 private:
  /// Returns `count` sizes from a place on, and moves the place behind them.
  std::vector<std::uint64_t> sizes(std::size_t& at, std::uint64_t count) const {
    if (at > data_.size() || count > (data_.size() - at) / sizeof(std::uint64_t))
      throw std::runtime_error("a whole file");
    std::vector<std::uint64_t> found(count);
    std::memcpy(found.data(), data_.data() + at, count * sizeof(std::uint64_t));
    at += count * sizeof(std::uint64_t);
    return found;
  }

  std::string_view part(std::size_t& at, std::uint64_t size) const {
    if (size > data_.size() - at) throw std::runtime_error("a whole file");
    at += size;
    return data_.substr(at - size, size);
  }

  std::string unpacked(std::size_t at, std::size_t wanted) const {
    const auto check = [&](bool holds) {
      if (!holds) throw std::runtime_error("arrays with the numbers of all particles");
    };
    if (codec_ == vtk::Codec::none) {
      const auto size = sizes(at, 1);
      check(size[0] == wanted);
      return std::string(part(at, wanted));
    }
    const auto blocks = sizes(at, 3);
    const auto packed = sizes(at, blocks[0]);
    std::string out(wanted, '\0');
    std::size_t filled = 0;
    for (std::size_t n = 0; n < packed.size(); ++n) {
      const std::uint64_t size = n + 1 == packed.size() && blocks[2] > 0 ? blocks[2] : blocks[1];
      check(size <= wanted - filled);
      check(vtk::unpack(codec_, part(at, packed[n]), std::span(out).subspan(filled, size)));
      filled += size;
    }
    check(filled == wanted);
    return out;
  }

  std::string_view data_;
  vtk::Codec codec_ = vtk::Codec::none;
};

/// Returns the text between `<name>` and `</name>`.
std::string_view inside(std::string_view text, std::string_view name) {
  const std::size_t start = text.find(fmt::format("<{}>", name));
  const std::size_t end = text.find(fmt::format("</{}>", name));
  if (start == std::string_view::npos || end == std::string_view::npos || end < start)
    throw std::runtime_error(fmt::format("a part {}", name));
  return text.substr(start, end - start);
}

}  // namespace

std::optional<std::string> attribute(std::string_view tag, std::string_view name) {
  const std::string start = fmt::format(" {}=\"", name);
  const std::size_t at = tag.find(start);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = tag.substr(at + start.size());
  const std::size_t end = rest.find('"');
  if (end == std::string_view::npos) return std::nullopt;
  return std::string(rest.substr(0, end));
}

std::vector<std::string_view> tags(std::string_view text, std::string_view name) {
  std::vector<std::string_view> found;
  const std::string start = fmt::format("<{} ", name);
  for (std::size_t at = text.find(start); at != std::string_view::npos; at = text.find(start, at)) {
    const std::size_t end = std::min(text.find('>', at), text.size());
    found.push_back(text.substr(at, end - at));
    at = end;
  }
  return found;
}

VtuFrame read_vtu(std::string_view bytes, std::size_t most) {
  constexpr std::string_view mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t place = bytes.find(mark);
  if (place == std::string_view::npos)
    throw std::runtime_error("a VTK file with appended raw arrays");
  const std::string_view head = bytes.substr(0, place);
  const Arrays arrays(head, bytes.substr(place + mark.size()));
  const auto pieces = tags(head, "Piece");
  const auto points = tags(inside(head, "Points"), "DataArray");
  if (pieces.size() != 1 || points.size() != 1) throw std::runtime_error("one piece with points");
  VtuFrame frame;
  frame.particles = count_in(pieces.front(), "NumberOfPoints", most);
  frame.points = arrays.read(points.front(), 3 * frame.particles);
  for (const std::string_view tag : tags(inside(head, "PointData"), "DataArray")) {
    constexpr std::size_t most_components = 9;
    VtuField& field = frame.fields.emplace_back();
    field.name = attribute(tag, "Name").value_or("");
    const std::size_t count = attribute(tag, "NumberOfComponents")
                                  ? count_in(tag, "NumberOfComponents", most_components)
                                  : 1;
    for (std::size_t n = 0; n < count; ++n)
      field.components.push_back(attribute(tag, fmt::format("ComponentName{}", n))
                                     .value_or(count == 1 ? "" : std::to_string(n)));
    field.values = arrays.read(tag, count * frame.particles);
  }
  return frame;
}

}  // namespace hyperlattice::report
