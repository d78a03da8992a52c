// The face-centred cubic lattice with 18 neighbours: particles at
//   x = anchor + a (1/4 + i + j/2 + k/2, 1/4 + j/2, 1/4 + k/2),
// so that each whole cube of edge a holds four particles. Springs join a particle to its 12 nearest
// neighbours (length a/sqrt(2), class 0) and to the next 6 (length a, class 1). The lattice is
// isotropic if springs of class 1 have 1/4 of the stiffness of class 0.
#include <hyperlattice/filling.hpp>

namespace {
using namespace hyperlattice;

constexpr Basis basis{Vec3{1, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0.5, 0, 0.5}};

// The 9 neighbours that follow in the order z, y, x, in steps of the basis; the other 9 are
// opposite to them.
constexpr Neighbour neighbours[] = {
    {1, 0, 0, 1},                 // along the row: (1, 0, 0) a
    {-1, 1, 0, 0}, {0, 1, 0, 0},  // to the next row: (-1/2 or 1/2, 1/2, 0) a
    {-1, 2, 0, 1},                // to the row after it: (0, 1, 0) a
    {0, -1, 1, 0}, {-1, 0, 1, 0}, {0, 0, 1, 0},
    {-1, 1, 1, 0},  // to the next plane: (0, -1/2 or 1/2, 1/2) a, (-1/2 or 1/2, 0, 1/2) a
    {-1, 0, 2, 1},  // to the plane after it: (0, 0, 1) a
};

constexpr std::string_view boundaries[] = {"particles", "cells"};

class Fcc {
 public:
  struct Options {
    double spacing = 0;
    const Shape* shape = nullptr;
    std::optional<Vec3> anchor;
    Boundary boundary = Boundary::particles;
  };

  static Schema<Options> schema() {
    return Schema<Options>("lattices.fcc", "Face-centred cubic lattice of 18 neighbours")
        .equation(
            "x = anchor + (1/4, 1/4, 1/4) spacing + spacing (i, j, k) and the same + spacing / 2 "
            "along two of the axes; V = spacing^3 / 4, Delta = "
            "spacing; "
            "base springs: k to the 12 nearest, k / 4 to the next 6; isotropic, and with membrane "
            "I-m for k_gamma = k_beta / 6")
        .source(
            "crystallography; isotropy from the sum over the neighbours (docs/theory/lattices.md)")
        .restrictions(
            "boundary particles only; k_beta goes with the 12 nearest neighbours, k_gamma with the "
            "next 6")
        .add<&Options::spacing>("spacing", "m",
                                "edge a of the cubic cell that holds four particles; nearest "
                                "neighbours are 1/sqrt(2) of it apart")
        .positive()
        .add<&Options::shape>("shape", "",
                              "the solid that is filled: with the sites that are inside")
        .add<&Options::anchor>("anchor", "m",
                               "where a corner of the cells is; left out: the centre of a round "
                               "shape, the low corner of a box")
        .add<&Options::boundary>("boundary", "",
                                 "particles: every particle and spring counts in full")
        .choices(boundaries)
        .fallback("\"particles\"")
        .check([](const Options& options, const FaultSink& faults) {
          if (has_cells(options.boundary))
            faults.fault("boundary",
                         "particles: its springs are not the edges and diagonals of one kind of "
                         "cell, so that none could be shared out");
        });
  }

  explicit Fcc(const Options& options)
      : spacing_(options.spacing),
        shape_(*options.shape),
        anchor_(options.anchor.value_or(options.shape->anchor)) {}

  void build(const LatticeSink& sink) const {
    Grid grid;
    grid.spacing = grid.membrane_distance = spacing_;
    grid.basis = basis;
    grid.site_volume = spacing_ * spacing_ * spacing_ / 4;
    grid.neighbours = neighbours;
    grid.spring_classes = 2;
    grid.class_stiffness = {1, 0.25};
    Filling(grid, shape_, anchor_, {0.25, 0.25, 0.25}).send(sink);
  }

 private:
  double spacing_;
  const Shape& shape_;
  Vec3 anchor_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Fcc>(); }
