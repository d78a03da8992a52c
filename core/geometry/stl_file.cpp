// STL files: a list of facets with three corners each, as text or as binary with 50 bytes per
// facet.
#include <base/visible.hpp>
#include <geometry/triangle_mesh.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>

namespace hyperlattice {

namespace {

class MeshBuilder {
 public:
  explicit MeshBuilder(double scale) : scale_(scale) {}

  void corner(double x, double y, double z, const std::string& where) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      throw std::runtime_error(where + ": a coordinate is not finite");
    const std::array<double, 3> key{x + 0.0, y + 0.0, z + 0.0};  // makes -0 and 0 equal
    const auto [found, is_new] =
        known_.emplace(key, static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(scale_ * Vec3{key[0], key[1], key[2]});
    facet_[corners_++] = found->second;
    if (corners_ < 3) return;
    corners_ = 0;
    ++count_;
    if (facet_[0] == facet_[1] || facet_[1] == facet_[2] || facet_[2] == facet_[0]) return;
    mesh_.facets.push_back(facet_);
    mesh_.numbers.push_back(count_);
  }
  void begin_section() { mesh_.sections.push_back(mesh_.facets.size()); }

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
  std::uint32_t count_ = 0;  // number of facets, also those without area
};

constexpr std::size_t header_bytes = 80, facet_bytes = 50;

template <class Number>
Number little_endian(const char* bytes) {
  static_assert(std::endian::native == std::endian::little);
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// Returns whether the start of the file has no byte 0. A text has none, while the count after a
/// binary file's header has one up to 16 million facets.
bool looks_like_text(std::string_view bytes) {
  return bytes.substr(0, header_bytes + 4).find('\0') == std::string_view::npos;
}

TriangleMesh read_binary(std::string_view bytes, double scale) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw std::runtime_error("it is a text in UTF-16: save it in ASCII or UTF-8");
  if (bytes.size() < header_bytes + 4)
    throw std::runtime_error(fmt::format(
        "it is cut short: {} bytes are less than the header of a binary STL", bytes.size()));
  const std::size_t facets = little_endian<std::uint32_t>(bytes.data() + header_bytes),
                    needed = header_bytes + 4 + facets * facet_bytes;
  if (bytes.size() < needed)
    throw std::runtime_error(fmt::format(
        "it is cut short: {} facets need {} bytes, and it has {}{}", facets, needed, bytes.size(),
        looks_like_text(bytes) ? "; a text would begin with \"solid\"" : ""));
  const std::string_view behind = bytes.substr(needed);  // some programs pad the file
  if (behind.find_first_not_of(std::string_view(" \t\r\n\0", 5)) != std::string_view::npos)
    throw std::runtime_error(
        fmt::format("it counts {} facets, and {} bytes stand behind them: are these several "
                    "solids, or is the count wrong?",
                    facets, behind.size()));
  MeshBuilder builder(scale);
  builder.begin_section();
  for (std::size_t facet = 0; facet < facets; ++facet)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const char* at = bytes.data() + header_bytes + 4 + facet * facet_bytes +
                       12 * (corner + 1);  // after the normal
      builder.corner(little_endian<float>(at), little_endian<float>(at + 4),
                     little_endian<float>(at + 8), fmt::format("facet {}", facet + 1));
    }
  return builder.take();
}

/// Splits a text at blanks into words and counts lines. Comparisons ignore case; lines end with LF,
/// CR or both.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  std::string_view next() {
    for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) line_ += ends_line() ? 1U : 0U;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void skip_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
  void expect(std::string_view word) {
    if (const auto found = next(); !is(found, word)) fail(fmt::format("\"{}\"", word), found);
  }
  /// Reads "endloop", which some programs write as "end loop".
  void expect_end(std::string_view of) {
    if (const auto found = next(); is(found, "end"))
      expect(of);
    else if (!is(found.substr(0, 3), "end") || !is(found.substr(3), of))
      fail(fmt::format("\"end{}\"", of), found);
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
        fmt::format("line {}: {} was expected, {}", line_, expected,
                    found.empty() ? "but it ends"
                                  : fmt::format("not \"{}\"", visible(found.substr(0, 40), 200))));
  }
  std::string place() const { return fmt::format("line {}", line_); }

  static bool is(std::string_view found, std::string_view word) {
    const auto same = [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    };
    return std::equal(found.begin(), found.end(), word.begin(), word.end(), same);
  }
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

 private:
  bool ends_line() const {
    return text_[at_] == '\n' || (text_[at_] == '\r' && text_.substr(at_ + 1, 1) != "\n");
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

void read_facet(Words& words, MeshBuilder& builder) {
  words.expect("normal");
  for (int n = 0; n < 3; ++n) words.next();  // the order of the corners gives the normal
  words.expect("outer");
  words.expect("loop");
  for (int corner = 0; corner < 3; ++corner) {
    words.expect("vertex");
    const double x = words.number(), y = words.number(), z = words.number();
    builder.corner(x, y, z, words.place());
  }
  words.expect_end("loop");
  words.expect_end("facet");
}

/// Reads sections from "solid" to "endsolid", one after the other: several solids, or patches of
/// one surface.
TriangleMesh read_text(std::string_view text, double scale) {
  MeshBuilder builder(scale);
  Words words(text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (!Words::is(word, "solid")) words.fail("\"solid\" or the end", word);
    words.skip_line();  // name of the solid
    builder.begin_section();
    for (word = words.next(); !Words::is(word, "endsolid"); word = words.next()) {
      if (Words::is(word, "end")) {
        words.expect("solid");
        break;
      }
      if (!Words::is(word, "facet")) words.fail("\"facet\" or \"endsolid\"", word);
      read_facet(words, builder);
    }
    words.skip_line();
  }
  return builder.take();
}

/// Returns the text after a byte order mark, if the file is a text. Binary files may also begin
/// with "solid"; their length and their count identify them.
std::optional<std::string_view> text_in(std::string_view bytes) {
  constexpr std::string_view mark = "\xEF\xBB\xBF", solid = "solid";
  // line 1 begins here
  const std::string_view whole = bytes.substr(bytes.starts_with(mark) ? mark.size() : 0);
  std::string_view text = whole;
  while (!text.empty() && Words::is_blank(text.front())) text.remove_prefix(1);
  if (!Words::is(text.substr(0, solid.size()), solid)) return std::nullopt;
  if (bytes.size() < header_bytes + 4) return whole;
  const std::size_t facets = little_endian<std::uint32_t>(bytes.data() + header_bytes);
  const bool is_binary =
      bytes.size() == header_bytes + 4 + facets * facet_bytes || !looks_like_text(bytes);
  return is_binary ? std::nullopt : std::optional(whole);
}

}  // namespace

TriangleMesh read_stl(std::string_view bytes, double scale) {
  const auto text = text_in(bytes);
  return text ? read_text(*text, scale) : read_binary(bytes, scale);
}

}  // namespace hyperlattice
