// Pictures of a small body by writers.render, in tests.
#pragma once

#include <support/output.hpp>
#include <support/png.hpp>
#include <support/program.hpp>

#include <fstream>

namespace hyperlattice::test {

/// A block of particles, 1 mm apart: cubes of 1 mm, or the corners of cells of 1 mm.
class Block {
 public:
  explicit Block(std::array<std::int32_t, 3> count, bool corners_of_cells = false) {
    for (std::int32_t k = 0; k < count[2]; ++k)
      for (std::int32_t j = 0; j < count[1]; ++j)
        for (std::int32_t i = 0; i < count[0]; ++i)
          positions_.insert(positions_.end(),
                            {edge * (i + 0.5), edge * (j + 0.5), edge * (k + 0.5)});
    particles = positions_.size() / 3;
    for (Particle n = 0; n < particles; ++n) all_.push_back(n);
    displacement.assign(positions_.size(), 0);
    pressure.assign(particles, 0);
    open.assign(particles, 0);
    closed.assign(particles, 0);
    fragment.assign(particles, 0);
    take_cubes(count, corners_of_cells);
  }

  /// Moves each particle from its place at rest, m, to another one.
  void move(const std::function<Vec3(Vec3)>& to) {
    for (Particle n = 0; n < particles; ++n) {
      const Vec3 from{positions_[3 * n], positions_[3 * n + 1], positions_[3 * n + 2]},
          now = to(from);
      for (std::size_t axis = 0; axis < 3; ++axis)
        displacement[3 * n + axis] = now[axis] - from[axis];
    }
  }
  /// Takes the cubes away whose middle is not inside.
  void keep(const std::function<bool(Vec3)>& inside) {
    for (std::size_t n = 0; n < owners_.size(); ++n) {
      const auto nx = static_cast<std::size_t>(cubes_.count[0]),
                 ny = static_cast<std::size_t>(cubes_.count[1]);
      const Vec3 place{double(n % nx), double(n / nx % ny), double(n / nx / ny)};
      if (!inside(cubes_.origin + cubes_.edge * (place + Vec3{0.5, 0.5, 0.5})))
        owners_[n] = BodyCubes::no_particle;
    }
  }
  /// Breaks the spring between two particles.
  void break_spring(Particle a, Particle b) {
    CrackFace face;
    face.a = a;
    face.b = b;
    face.area = edge * edge;
    face.damage = 1;
    faces_.push_back(face);
  }

  OutputContext context(std::string_view directory) {
    OutputContext context;
    context.directory = directory;
    context.title = "A block & its title";
    context.self = this;
    context.region_particles = [](void* self, RegionId) noexcept -> std::span<const Particle> {
      return static_cast<Block*>(self)->all_;
    };
    context.receive_warning = [](void* self, std::string_view sentence) noexcept {
      static_cast<Block*>(self)->warnings.emplace_back(sentence);
    };
    return context;
  }
  Snapshot snapshot() {
    Snapshot snapshot;
    snapshot.time = 2e-6;
    snapshot.particles = particles;
    snapshot.spacing = edge;
    snapshot.positions = positions_;
    snapshot.self = this;
    snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
      auto& block = *static_cast<Block*>(self);
      const std::pair<std::string_view, Field> fields[] = {
          {"displacement", {3, block.displacement}},
          {"pressure", {1, block.pressure}},
          {"broken_open", {1, block.open}},
          {"broken_closed", {1, block.closed}}};
      for (const auto& [known, values] : fields)
        if (known == name) {
          field = values;
          return true;
        }
      return false;
    };
    snapshot.get_fragments = [](void* self, double, Field& numbers) noexcept {
      numbers = {1, static_cast<Block*>(self)->fragment};
      return true;
    };
    snapshot.get_crack_faces = [](void* self, double) noexcept {
      return std::span<const CrackFace>(static_cast<Block*>(self)->faces_);
    };
    snapshot.get_cubes = [](void* self) noexcept {
      auto& block = *static_cast<Block*>(self);
      block.cubes_.particle = block.owners_;
      return block.cubes_;
    };
    return snapshot;
  }

  static constexpr double edge = 1e-3;
  std::uint64_t particles = 0;
  std::vector<double> displacement, pressure, open, closed, fragment;
  std::vector<std::string> warnings;

 private:
  void take_cubes(std::array<std::int32_t, 3> count, bool corners_of_cells) {
    const std::int32_t parts = corners_of_cells ? 2 : 1, less = corners_of_cells ? 1 : 0;
    cubes_.edge = edge / parts;
    const double low = corners_of_cells ? edge / 2 : 0;
    cubes_.origin = {low, low, low};
    for (int axis = 0; axis < 3; ++axis)
      cubes_.count[axis] = parts * (count[static_cast<std::size_t>(axis)] - less);
    for (std::int32_t k = 0; k < cubes_.count[2]; ++k)
      for (std::int32_t j = 0; j < cubes_.count[1]; ++j)
        for (std::int32_t i = 0; i < cubes_.count[0]; ++i) {
          const auto at = [&](std::int32_t n) { return (n + less) / parts; };
          owners_.push_back(
              static_cast<std::uint32_t>((at(k) * count[1] + at(j)) * count[0] + at(i)));
        }
  }

  std::vector<double> positions_;
  std::vector<Particle> all_;
  std::vector<CrackFace> faces_;
  std::vector<std::uint32_t> owners_;
  BodyCubes cubes_;
};

/// Options without texts and light: colours are exactly those of the particles.
inline nlohmann::json bare(nlohmann::json more = nlohmann::json::object()) {
  nlohmann::json options{
      {"title", ""},      {"legend", false}, {"scale_bar", false},      {"axes", false},
      {"outline", false}, {"light", 0},      {"colour_by", "pressure"}, {"range", {0, 1}},
      {"width", 500},     {"height", 500}};
  options.update(more);
  return options;
}

inline std::string draw_file(Block& block, const nlohmann::json& options,
                             const std::string& extension = "png") {
  const Folder folder("render");
  Plugin writer("writers.render", options);
  writer.begin(block.context(folder.path()));
  writer.frame(block.snapshot());
  writer.end();
  return contents(folder.file("render_000000." + extension));
}

inline Pixels draw(Block& block, const nlohmann::json& options) {
  const Folder folder("render_png");
  const std::string file = folder.file("picture.png");
  std::ofstream(file, std::ios::binary) << draw_file(block, options);
  return read_png(file);
}

}  // namespace hyperlattice::test
