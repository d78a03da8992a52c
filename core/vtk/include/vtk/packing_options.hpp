// Options of writers of VTK files: how arrays are packed, and how many digits they have.
#pragma once

#include <vtk/codec.hpp>

#include <hyperlattice/options.hpp>

namespace hyperlattice::vtk {

enum class Digits : std::uint32_t { single_precision, double_precision };
inline constexpr std::string_view precisions[] = {"single", "double"};

struct PackingOptions {
  Codec codec = Codec::lz4;
  Digits precision = Digits::single_precision;
};

template <class Options>
Schema<Options>& add_codec_option(Schema<Options>& schema) {
  return schema
      .template add<&Options::codec>("codec", "",
                                     "how arrays are packed; lz4: almost as fast as none; zlib: "
                                     "the smallest files, and by far the most time")
      .choices(codecs)
      .fallback("\"lz4\"");
}

template <class Options>
Schema<Options>& add_precision_option(Schema<Options>& schema) {
  return schema
      .template add<&Options::precision>("precision", "",
                                         "of the numbers in the files: single has 7 digits, double "
                                         "has all 16 and takes twice the space")
      .choices(precisions)
      .fallback("\"single\"");
}

}  // namespace hyperlattice::vtk
