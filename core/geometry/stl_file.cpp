// STL files: a list of facets, three corners each, as text or as 50 bytes a facet.
#include <geometry/triangle_mesh.hpp>

#include <spdlog/fmt/fmt.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

namespace hyperlattice {

namespace {

class MeshBuilder {
 public:
  explicit MeshBuilder(double scale) : scale_(scale) {}

  void corner(double x, double y, double z, const std::string& where) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) throw std::runtime_error(where + ": a coordinate is not finite");
    const std::array<double, 3> key{x + 0.0, y + 0.0, z + 0.0};  // -0 and 0 are one place
    const auto [found, is_new] = known_.emplace(key, static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(scale_ * Vec3{key[0], key[1], key[2]});
    facet_[corners_++] = found->second;
    if (corners_ < 3) return;
    corners_ = 0;
    if (facet_[0] != facet_[1] && facet_[1] != facet_[2] && facet_[2] != facet_[0]) mesh_.facets.push_back(facet_);
  }

  TriangleMesh take() {
    if (mesh_.facets.empty()) throw std::runtime_error("it has no facets");
    return std::move(mesh_);
  }

 private:
  double scale_;
  TriangleMesh mesh_;
  std::map<std::array<double, 3>, std::uint32_t> known_;
  std::array<std::uint32_t, 3> facet_{};
  std::size_t corners_ = 0;
};

constexpr std::size_t header_bytes = 80, facet_bytes = 50;

template <class Number>
Number little_endian(const char* bytes) {
  static_assert(std::endian::native == std::endian::little);
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

TriangleMesh read_binary(std::string_view bytes, double scale) {
  if (bytes.size() < header_bytes + 4)
    throw std::runtime_error(fmt::format("it is cut short: {} bytes are less than the header of a binary STL", bytes.size()));
  const std::size_t facets = little_endian<std::uint32_t>(bytes.data() + header_bytes), needed = header_bytes + 4 + facets * facet_bytes;
  if (bytes.size() < needed)
    throw std::runtime_error(fmt::format("it is cut short: {} facets need {} bytes, and it has {}", facets, needed, bytes.size()));
  MeshBuilder builder(scale);
  for (std::size_t facet = 0; facet < facets; ++facet)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const char* at = bytes.data() + header_bytes + 4 + facet * facet_bytes + 12 * (corner + 1);  // after the normal
      builder.corner(little_endian<float>(at), little_endian<float>(at + 4), little_endian<float>(at + 8), fmt::format("facet {}", facet + 1));
    }
  return builder.take();
}

/// Words between blanks, with the line that they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  std::string_view next() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n' ? 1u : 0u;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  void expect(std::string_view word) {
    if (const auto found = next(); found != word) fail(fmt::format("\"{}\"", word), found);
  }
  double number() {
    const auto word = next();
    const auto digits = word.substr(word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) fail("a number", word);
    return value;
  }
  [[noreturn]] void fail(const std::string& expected, std::string_view found) const {
    throw std::runtime_error(
        fmt::format("line {}: {} was expected, {}", line_, expected, found.empty() ? "but it ends" : fmt::format("not \"{}\"", found.substr(0, 40))));
  }
  std::string place() const { return fmt::format("line {}", line_); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

TriangleMesh read_text(std::string_view text, double scale) {
  MeshBuilder builder(scale);
  Words words(text);
  words.expect("solid");
  words.skip_line();  // its name
  for (std::string_view word = words.next(); word != "endsolid"; word = words.next()) {
    if (word != "facet") words.fail("\"facet\" or \"endsolid\"", word);
    words.expect("normal");
    for (int n = 0; n < 3; ++n) words.next();  // the order of the corners says it too
    words.expect("outer");
    words.expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      words.expect("vertex");
      const double x = words.number(), y = words.number(), z = words.number();
      builder.corner(x, y, z, words.place());
    }
    words.expect("endloop");
    words.expect("endfacet");
  }
  return builder.take();
}

/// Binary files may begin with "solid" too: their length tells.
bool is_text(std::string_view bytes) {
  if (!bytes.starts_with("solid")) return false;
  if (bytes.size() < header_bytes + 4) return true;
  const std::size_t facets = little_endian<std::uint32_t>(bytes.data() + header_bytes);
  return bytes.size() != header_bytes + 4 + facets * facet_bytes;
}

}  // namespace

TriangleMesh read_stl(std::string_view bytes, double scale) { return is_text(bytes) ? read_text(bytes, scale) : read_binary(bytes, scale); }

}  // namespace hyperlattice
