// Surfaces that cut springs, and their files, for tests.
#pragma once

#include <support/scene_builder.hpp>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>

namespace hyperlattice::test {

/// A file that exists as long as the object.
class InputText {
 public:
  InputText(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("hyperlattice_cut_" + std::to_string(::getpid()) + "_" + name)) {
    std::ofstream(path_) << text;
  }
  InputText(const InputText&) = delete;
  InputText& operator=(const InputText&) = delete;
  ~InputText() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

inline Json plane(Vec3 point, Vec3 normal) {
  return {{"plane", {{"point", point}, {"normal", normal}}}};
}
inline Json disc(Vec3 centre, Vec3 normal, double radius) {
  return {{"disc", {{"centre", centre}, {"normal", normal}, {"radius", radius}}}};
}

/// The text of an STL file with these facets.
inline std::string facets(std::initializer_list<std::array<Vec3, 3>> triangles) {
  std::string text = "solid\n";
  for (const auto& corners : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3 x : corners) text += fmt::format("vertex {} {} {}\n", x.x, x.y, x.z);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

}  // namespace hyperlattice::test
