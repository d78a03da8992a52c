// The cubic lattice with 18 neighbours. A shape is filled with the cubic cells of side l whose
// centres lie inside it. The particles are at the centres of these cells,
//   x = anchor + (i + 1/2, j + 1/2, k + 1/2) l,
// or, with boundary cells, at their corners, x = anchor + (i, j, k) l. Partial cells are all that
// the shape touches, each with the share of its volume that is inside. Orthogonal springs (class 0)
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

constexpr std::string_view boundaries[] = {"particles", "cells", "partial_cells"};

class Cubic {
 public:
  struct Options {
    double spacing = 0;
    const Shape* shape = nullptr;
    std::optional<Vec3> anchor;
    Boundary boundary = Boundary::particles;
    std::optional<double> least_share;
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
            "a diagonal one by its cells / 2, so that the body is exactly the union of its cells. "
            "partial_cells: as cells, but all cells that the shape touches, and each counts by the "
            "share of its volume that is inside the shape; for round and oblique surfaces, whose "
            "error then falls as spacing^2")
        .choices(boundaries)
        .fallback("\"particles\"")
        .add<&Options::least_share>(
            "least_share", "",
            "with partial_cells: a cell with a smaller share of its volume inside the shape is "
            "left out, and the shape ends there; left out: 0.05. Lighter cells make the equations "
            "of static solvers worse, not the time step shorter")
        .at_least(1e-3)
        .at_most(1)
        .check([](const Options& options, const FaultSink& faults) {
          if (options.least_share && options.boundary != Boundary::partial_cells)
            faults.fault("least_share", "boundary partial_cells beside it");
        });
  }

  explicit Cubic(const Options& options)
      : spacing_(options.spacing),
        shape_(*options.shape),
        anchor_(options.anchor.value_or(options.shape->anchor)),
        boundary_(options.boundary),
        least_share_(options.least_share.value_or(0.05)) {}

  void build(const LatticeSink& sink) const {
    Grid grid;
    grid.boundary = boundary_;
    grid.spacing = grid.membrane_distance = spacing_;
    grid.site_volume = spacing_ * spacing_ * spacing_;
    grid.neighbours = neighbours;
    grid.spring_classes = 2;
    Filling(grid, shape_, anchor_, {0.5, 0.5, 0.5}, least_share_).send(sink);
  }

 private:
  double spacing_;
  const Shape& shape_;
  Vec3 anchor_;
  Boundary boundary_;
  double least_share_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Cubic>(); }
