#include "png.hpp"

#include <png.h>
#include <csetjmp>
#include <stdexcept>

namespace hyperlattice::picture {
namespace {

/// Encodes the image into `bytes`. Returns false if libpng fails. libpng then leaves by longjmp, so
/// no local variable here may own memory.
bool encode(png_structp png, png_infop info, const Image& image, png_textp texts, int text_count,
            std::string& bytes) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(
      png, &bytes,
      [](png_structp self, png_bytep data, png_size_t size) {
        static_cast<std::string*>(png_get_io_ptr(self))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 4);
  png_set_text(png, info, texts, text_count);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y)
    png_write_row(
        png,
        image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)].data());
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string encode_png(const Image& image, const Notes& notes) {
  std::vector<png_text> texts(notes.size());
  for (std::size_t n = 0; n < notes.size(); ++n) {
    texts[n] = {};
    texts[n].compression = PNG_ITXT_COMPRESSION_NONE;  // UTF-8
    texts[n].key = const_cast<png_charp>(notes[n].first.c_str());
    texts[n].text = const_cast<png_charp>(notes[n].second.c_str());
  }
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool done = info != nullptr &&
                    encode(png, info, image, texts.data(), static_cast<int>(texts.size()), bytes);
  png_destroy_write_struct(&png, &info);
  if (!done) throw std::runtime_error("libpng cannot encode the picture");
  return bytes;
}

}  // namespace hyperlattice::picture
