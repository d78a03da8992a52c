#include "legend.hpp"

#include <picture/palette.hpp>

namespace hyperlattice::picture {
namespace {

constexpr Colour ink{60, 60, 60};
constexpr int glyph_width = 6, glyph_height = 7;  // dots; the sixth column is a gap

/// Returns the dots of a glyph: seven rows of five bits.
const std::uint8_t* glyph(char c) {
  static constexpr std::uint8_t digits[10][7] = {
      {14, 17, 19, 21, 25, 17, 14}, {4, 12, 4, 4, 4, 4, 14},  {14, 17, 1, 2, 4, 8, 31},
      {31, 2, 4, 2, 1, 17, 14},     {2, 6, 10, 18, 31, 2, 2}, {31, 16, 30, 1, 1, 17, 14},
      {6, 8, 16, 30, 17, 17, 14},   {31, 1, 2, 4, 8, 8, 8},   {14, 17, 17, 14, 17, 17, 14},
      {14, 17, 17, 15, 1, 2, 12}};
  static constexpr std::uint8_t letters[26][7] = {
      {0, 0, 14, 1, 15, 17, 15},  {16, 16, 22, 25, 17, 17, 30}, {0, 0, 14, 16, 16, 17, 14},
      {1, 1, 13, 19, 17, 17, 15}, {0, 0, 14, 17, 31, 16, 14},   {6, 9, 8, 28, 8, 8, 8},
      {0, 15, 17, 17, 15, 1, 14}, {16, 16, 22, 25, 17, 17, 17}, {4, 0, 12, 4, 4, 4, 14},
      {2, 0, 6, 2, 2, 18, 12},    {16, 16, 18, 20, 24, 20, 18}, {12, 4, 4, 4, 4, 4, 14},
      {0, 0, 26, 21, 21, 17, 17}, {0, 0, 22, 25, 17, 17, 17},   {0, 0, 14, 17, 17, 17, 14},
      {0, 0, 30, 17, 30, 16, 16}, {0, 0, 13, 19, 15, 1, 1},     {0, 0, 22, 25, 16, 16, 16},
      {0, 0, 14, 16, 14, 1, 30},  {8, 8, 28, 8, 8, 9, 6},       {0, 0, 17, 17, 17, 19, 13},
      {0, 0, 17, 17, 17, 10, 4},  {0, 0, 17, 17, 21, 21, 10},   {0, 0, 17, 10, 4, 10, 17},
      {0, 0, 17, 17, 15, 1, 14},  {0, 0, 31, 2, 4, 8, 31}};
  static constexpr char others[] = "-+.=/()";
  static constexpr std::uint8_t marks[7][7] = {{0, 0, 0, 31, 0, 0, 0},  {0, 4, 4, 31, 4, 4, 0},
                                               {0, 0, 0, 0, 0, 12, 12}, {0, 0, 31, 0, 31, 0, 0},
                                               {0, 1, 2, 4, 8, 16, 0},  {2, 4, 8, 8, 8, 4, 2},
                                               {8, 4, 2, 2, 2, 4, 8}};
  static constexpr std::uint8_t blank[7] = {};
  if (c >= '0' && c <= '9') return digits[c - '0'];
  if (c >= 'a' && c <= 'z') return letters[c - 'a'];
  const std::size_t mark = std::string_view(others).find(c);
  return mark < 7 ? marks[mark] : blank;
}

int dot_size(int width) { return std::max(1, width / 450); }

int text_width(std::string_view text, int dot) {
  return static_cast<int>(text.size()) * glyph_width * dot;
}

void fill(Image& image, int left, int top, int width, int height, Colour colour) {
  for (int y = std::max(0, top); y < std::min(image.height, top + height); ++y)
    for (int x = std::max(0, left); x < std::min(image.width, left + width); ++x)
      image.at(x, y) = colour;
}

}  // namespace

int legend_height(int width) { return 5 * glyph_height * dot_size(width); }

int write_text(Image& image, int x, int y, std::string_view text) {
  const int dot = dot_size(image.width);
  for (const char c : text) {
    const std::uint8_t* rows = glyph(c);
    for (int row = 0; row < 7; ++row)
      for (int column = 0; column < 5; ++column)
        if ((rows[row] >> (4 - column)) & 1)
          fill(image, x + column * dot, y + row * dot, dot, dot, ink);
    x += glyph_width * dot;
  }
  return x;
}

void draw_keys(Image& image, const std::vector<Key>& keys) {
  const int dot = dot_size(image.width), square = glyph_height * dot, gap = 3 * dot,
            apart = 12 * dot;
  int width = -apart;
  for (const Key& key : keys) width += square + gap + text_width(key.text, dot) + apart;
  int x = (image.width - width) / 2;
  const int y = image.height - legend_height(image.width) / 2 - square / 2;
  for (const Key& key : keys) {
    fill(image, x, y, square, square, key.colour);
    x = write_text(image, x + square + gap, y, key.text) + apart;
  }
}

void draw_scale(Image& image, std::string_view low, std::string_view high,
                std::string_view quantity) {
  const int dot = dot_size(image.width), height = glyph_height * dot, width = image.width / 3,
            left = image.width / 3, gap = 6 * dot;
  const int y = image.height - legend_height(image.width) / 5 * 4;
  for (int x = 0; x < width; ++x) fill(image, left + x, y, 1, height, viridis(x / (width - 1.0)));
  write_text(image, left - gap - text_width(low, dot), y, low);
  write_text(image, left + width + gap, y, high);
  write_text(image, (image.width - text_width(quantity, dot)) / 2, y + 2 * height, quantity);
}

}  // namespace hyperlattice::picture
