// The cubic lattice with 18 neighbours. A shape is filled with the cubic cells of side l whose
// centres lie inside it. The particles are at the centres of these cells,
//   x = anchor + (i + 1/2, j + 1/2, k + 1/2) l,
// or, with boundary cells, at their corners, x = anchor + (i, j, k) l. Orthogonal springs (class 0)
// have the length l, face-diagonal springs (class 1) the length sqrt(2) l.
#include <hyperlattice/filling.hpp>

namespace {
using namespace hyperlattice;

// The 9 neighbours that follow in the order z, y, x, so that each spring is listed once.
constexpr Neighbour neighbours[] = {
    {1, 0, 0, 0},                                                            // along the row
    {-1, 1, 0, 1}, {0, 1, 0, 0},  {1, 1, 0, 1},                              // to the next row
    {0, -1, 1, 1}, {-1, 0, 1, 1}, {0, 0, 1, 0}, {1, 0, 1, 1}, {0, 1, 1, 1},  // to the next plane
};

constexpr std::string_view boundaries[] = {"particles", "cells"};

class Cubic {
 public:
  struct Options {
    double spacing = 0;
    const Shape* shape = nullptr;
    std::optional<Vec3> anchor;
    Boundary boundary = Boundary::particles;
  };

  static Schema<Options> schema() {
    return Schema<Options>("lattices.cubic", "Cubic lattice of 18 neighbours")
        .equation(
            "particles: x = anchor + (i + 1/2, j + 1/2, k + 1/2) spacing; cells: x = anchor + (i, "
            "j, k) spacing; V = spacing^3, Delta = spacing")
        .source(
            "Zhao 2017, section 2.1 and figure 1; particles at cell centres reproduce its count of "
            "490,432")
        .add<&Options::spacing>("spacing", "m",
                                "lattice constant l, the length of an orthogonal spring")
        .positive()
        .add<&Options::shape>(
            "shape", "", "the solid that is filled: with the cubic cells whose centres are inside")
        .add<&Options::anchor>("anchor", "m",
                               "where a corner of the cells is; left out: the centre of a round "
                               "shape, the low corner of a box")
        .add<&Options::boundary>(
            "boundary", "",
            "particles: one at each cell's centre; every particle and spring counts in full, as "
            "printed in the paper. cells: particles "
            "at the cells' corners; a particle's mass and alpha spring count by its cells / 8, an "
            "orthogonal spring by its cells / 4, "
            "a diagonal one by its cells / 2, so that the body is exactly the union of its cells")
        .choices(boundaries)
        .fallback("\"particles\"");
  }

  explicit Cubic(const Options& options)
      : spacing_(options.spacing),
        shape_(*options.shape),
        anchor_(options.anchor.value_or(options.shape->anchor)),
        boundary_(options.boundary) {}

  void build(const LatticeSink& sink) const {
    Grid grid;
    grid.boundary = boundary_;
    grid.spacing = grid.membrane_distance = spacing_;
    grid.site_volume = spacing_ * spacing_ * spacing_;
    grid.neighbours = neighbours;
    grid.spring_classes = 2;
    Filling(grid, shape_, anchor_, {0.5, 0.5, 0.5}).send(sink);
  }

 private:
  double spacing_;
  const Shape& shape_;
  Vec3 anchor_;
  Boundary boundary_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Cubic>(); }
