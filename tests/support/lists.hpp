// Listed lattices for tests: the cubic block as a table of points and a table of springs, and
// random blocks.
#pragma once

#include <support/scenes.hpp>

namespace hyperlattice::test {

/// The files of one test; the destructor removes them.
class ListFiles {
 public:
  /// Lists the block of block() in the order x, y, z; the grid numbers its particles in another
  /// order.
  ListFiles(int nx, int ny, int nz) : ListFiles() {
    std::ofstream table(points), joints(springs);
    table.precision(17);
    table << "x,y,z\n";
    joints << "a,b\n";
    const auto number = [&](int i, int j, int k) { return (i * ny + j) * nz + k; };
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k) {
          table << i + 0.5 << "," << j + 0.5 << "," << k + 0.5 << "\n";
          for (const auto& [x, y, z] : {std::array{1, 0, 0},
                                        {0, 1, 0},
                                        {0, 0, 1},
                                        {1, 1, 0},
                                        {1, -1, 0},
                                        {1, 0, 1},
                                        {1, 0, -1},
                                        {0, 1, 1},
                                        {0, 1, -1}}) {
            const int a = i + x, b = j + y, c = k + z;
            if (a >= 0 && a < nx && b >= 0 && b < ny && c >= 0 && c < nz)
              joints << number(a, b, c) << "," << number(i, j, k) << "\n";
          }
        }
  }
  /// Lists the given points and the springs between them.
  ListFiles(const std::vector<Vec3>& places, const std::vector<std::pair<int, int>>& pairs)
      : ListFiles() {
    std::ofstream table(points), joints(springs);
    table.precision(17);
    table << "x,y,z\n";
    joints << "a,b\n";
    for (const Vec3& x : places) table << x.x << "," << x.y << "," << x.z << "\n";
    for (const auto& [a, b] : pairs) joints << a << "," << b << "\n";
  }
  ~ListFiles() {
    std::filesystem::remove(points);
    std::filesystem::remove(springs);
  }
  ListFiles(const ListFiles&) = delete;
  ListFiles& operator=(const ListFiles&) = delete;

  /// The lattice stage that reads these files, with `more` keys.
  Stages lattice(const Keys& more = {}) const {
    return stage("lattices.points", Keys{{"points", points.string()},
                                         {"springs", springs.string()},
                                         {"scale", "1 mm"},
                                         {"spacing", "1 mm"}} +
                                        more);
  }

  std::filesystem::path points, springs;

 private:
  ListFiles() {
    static int count = 0;
    const std::string name =
        "hyperlattice_list_" + std::to_string(::getpid()) + "_" + std::to_string(count++);
    points = std::filesystem::temp_directory_path() / (name + "_points.csv");
    springs = std::filesystem::temp_directory_path() / (name + "_springs.csv");
  }
};

/// Maps each particle of a listed cubic block to the same particle of the block as a grid.
class InGrid {
 public:
  InGrid() = default;
  InGrid(int nx, int ny, int nz, const Model& list) {
    const auto x = static_cast<Particle>(nx), y = static_cast<Particle>(ny),
               z = static_cast<Particle>(nz);
    for (const Particle n : list.body.listed.source)
      particle_.push_back(((n % z) * y + n / z % y) * x + n / z / y);  // in the order of ListFiles
  }
  std::size_t size() const { return particle_.size(); }
  const Particle& operator[](Particle of_list) const { return particle_[of_list]; }

  /// Reorders a field of the grid into the order of the list.
  std::vector<double> for_list(const std::vector<double>& of_grid) const {
    const std::size_t components = of_grid.size() / size();
    std::vector<double> of_list;
    for (const Particle n : particle_)
      for (std::size_t c = 0; c < components; ++c) of_list.push_back(of_grid[n * components + c]);
    return of_list;
  }

 private:
  std::vector<Particle> particle_;
};

/// A scene of a lattice stage, the keys of a material, and more stages.
inline std::string listed_scene(const Stages& lattice, const Keys& material,
                                const Stages& stages = {}, double young = 1e10) {
  return SceneBuilder{}
      .stages(lattice)
      .material("materials.elastic", Keys{{"density", 2500}, {"young", young}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// The same scene with a state in single precision.
inline std::string in_floats(const std::string& scene) {
  return SceneBuilder(scene).key("precision", "float").text();
}

/// A random lattice that fills a box of nx * ny * nz mm, spacing 1 mm.
inline Stages random_lattice(int nx, int ny, int nz, const Keys& more = {}) {
  return stage("lattices.random", Keys{{"spacing", "1 mm"}, {"shape", box_mm(nx, ny, nz)}} + more);
}

}  // namespace hyperlattice::test
