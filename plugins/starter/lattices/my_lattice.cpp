// The cubic lattice with 26 neighbours: particles at the centres of cubic cells of side l,
//   x = anchor + (i + 1/2, j + 1/2, k + 1/2) l,
// joined by springs along the edges (class 0, length l), the diagonals of faces (class 1, sqrt(2)
// l) and of the cells (class 2, sqrt(3) l). With stiffness k, k / 3 and k / 4 the lattice is
// isotropic: C11 = k + 2 k1 + 4/3 k2 is three times C12 = C44 = k1 + 4/3 k2, over l.
#include <hyperlattice/filling.hpp>

namespace {
using namespace hyperlattice;

// Half of the 26 neighbours, those that follow in the order z, y, x, so that each spring stands
// once; each with its class.
constexpr Neighbour neighbours[] = {
    {1, 0, 0, 0},                                  // along the row
    {-1, 1, 0, 1},  {0, 1, 0, 0},  {1, 1, 0, 1},   // to the next row
    {-1, -1, 1, 2}, {0, -1, 1, 1}, {1, -1, 1, 2},  // to the next plane
    {-1, 0, 1, 1},  {0, 0, 1, 0},  {1, 0, 1, 1},  {-1, 1, 1, 2}, {0, 1, 1, 1}, {1, 1, 1, 2},
};

class MyLattice {
 public:
  struct Options {
    double spacing = 0;
    const Shape* shape = nullptr;
  };

  static Schema<Options> schema() {
    return Schema<Options>("lattices.my_lattice", "Cubic lattice of 26 neighbours")
        .equation(
            "x = anchor + (i + 1/2, j + 1/2, k + 1/2) spacing; V = spacing^3, Delta = spacing; "
            "stiffness k, k / 3, k / 4")
        .add<&Options::spacing>("spacing", "m",
                                "lattice constant l, the length of the shortest spring")
        .positive()
        .add<&Options::shape>("shape", "",
                              "the solid that is filled: with the cells whose centres are inside");
  }

  explicit MyLattice(const Options& options) : spacing_(options.spacing), shape_(*options.shape) {}

  // The grid, then its rows of particles, which Filling finds. A lattice that is no grid sends a
  // list: sink.points().
  void build(const LatticeSink& sink) const {
    Grid grid;
    grid.spacing = grid.membrane_distance = spacing_;
    grid.site_volume = spacing_ * spacing_ * spacing_;
    grid.neighbours = neighbours;
    grid.spring_classes = 3;
    grid.class_stiffness = {1, 1.0 / 3, 1.0 / 4};
    Filling(grid, shape_, shape_.anchor, {0.5, 0.5, 0.5}).send(sink);
  }

 private:
  double spacing_;
  const Shape& shape_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<MyLattice>(); }
