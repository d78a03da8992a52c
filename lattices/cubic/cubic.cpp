// The cubic lattice with 18 neighbours: particles at the centres of the cubic cells of side l whose centres lie inside a shape,
//   x = anchor + (i + 1/2, j + 1/2, k + 1/2) l,
// or with boundary cells at the corners of these cells, x = anchor + (i, j, k) l,
// joined by orthogonal springs of length l (class 0) and face-diagonal springs of length sqrt(2) l (class 1).
#include <hyperlattice/lattice.hpp>

#include <algorithm>
#include <stdexcept>

namespace {
using namespace hyperlattice;

// Half of the 18 neighbours, those that follow in the order z, y, x: so each spring stands once.
constexpr Neighbour neighbours[] = {
    {1, 0, 0, 0},                                                            // along the row
    {-1, 1, 0, 1}, {0, 1, 0, 0},  {1, 1, 0, 1},                              // to the next row
    {0, -1, 1, 1}, {-1, 0, 1, 1}, {0, 0, 1, 0}, {1, 0, 1, 1}, {0, 1, 1, 1},  // to the next plane
};

constexpr std::string_view boundaries[] = {"particles", "cells"};

constexpr double most_sites_along_an_axis = 2147483646.0;
constexpr double most_sites = 4e9;

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
            "particles: x = anchor + (i + 1/2, j + 1/2, k + 1/2) spacing; cells: x = anchor + (i, j, k) spacing; V = spacing^3, Delta = spacing")
        .source("Zhao 2017, section 2.1 and figure 1; particles at cell centres reproduce its count of 490,432")
        .add<&Options::spacing>("spacing", "m", "lattice constant l, the length of an orthogonal spring")
        .positive()
        .add<&Options::shape>("shape", "", "the solid that is filled: with the cubic cells whose centres are inside")
        .add<&Options::anchor>("anchor", "m", "where a corner of the cells is; left out: the centre of a round shape, the low corner of a box")
        .add<&Options::boundary>(
            "boundary", "",
            "particles: one at each cell's centre; every particle and spring counts in full, as printed in the paper. cells: particles "
            "at the cells' corners; a particle's mass and alpha spring count by its cells / 8, an orthogonal spring by its cells / 4, "
            "a diagonal one by its cells / 2, so that the body is exactly the union of its cells")
        .choices(boundaries)
        .fallback("\"particles\"");
  }

  explicit Cubic(const Options& options)
      : spacing_(options.spacing), shape_(*options.shape), anchor_(options.anchor.value_or(options.shape->anchor)), boundary_(options.boundary) {}

  void build(const LatticeSink& sink) const {
    const Span x = cells(shape_.low.x, shape_.high.x, anchor_.x), y = cells(shape_.low.y, shape_.high.y, anchor_.y),
               z = cells(shape_.low.z, shape_.high.z, anchor_.z);
    constexpr const char* nothing_inside = "no cell's centre is inside the shape: expected a smaller spacing or a larger shape";
    if (x.count() * y.count() * z.count() == 0) throw std::invalid_argument(nothing_inside);
    if (x.count() * y.count() * z.count() > most_sites)
      throw std::invalid_argument("spacing is too small for this shape: its box would hold more than 4e9 sites");

    Grid grid;
    grid.boundary = boundary_;
    const double corner = boundary_ == Boundary::cells ? 0.5 : 0;  // from a cell's centre back to its low corner, in cells
    grid.origin = {centre(x.first - corner, anchor_.x), centre(y.first - corner, anchor_.y), centre(z.first - corner, anchor_.z)};
    grid.spacing = grid.membrane_distance = spacing_;
    const auto nx = static_cast<std::int32_t>(x.count()), ny = static_cast<std::int32_t>(y.count()), nz = static_cast<std::int32_t>(z.count());
    const std::int32_t more = boundary_ == Boundary::cells ? 1 : 0;  // corners than cells
    grid.sites = {nx + more, ny + more, nz + more};
    grid.site_volume = spacing_ * spacing_ * spacing_;
    grid.neighbours = neighbours;
    grid.spring_classes = 2;
    grid.shape = &shape_;
    sink.grid(grid);

    bool empty = true;
    for (std::int32_t k = 0; k < nz; ++k)
      for (std::int32_t j = 0; j < ny; ++j) {
        const auto inside = [&](std::int32_t i) {
          return shape_.contains({centre(x.first + i, anchor_.x), centre(y.first + j, anchor_.y), centre(z.first + k, anchor_.z)});
        };
        for (std::int32_t i = 0; i < nx; ++i) {
          if (!inside(i)) continue;
          const std::int32_t begin = i;
          while (++i < nx && inside(i)) {
          }
          sink.run(j, k, begin, i);
          empty = false;
        }
      }
    if (empty) throw std::invalid_argument(nothing_inside);
  }

 private:
  /// Cells first .. last along an axis.
  struct Span {
    double first = 0, last = -1;
    double count() const { return std::max(0.0, last - first + 1); }
  };

  double centre(double cell, double anchor) const { return anchor + (cell + 0.5) * spacing_; }

  /// The cells whose centres may lie between low and high; the shape itself decides.
  Span cells(double low, double high, double anchor) const {
    if (!std::isfinite(low) || !std::isfinite(high))
      throw std::invalid_argument("the shape has no end: expected a bounded one, such as the intersection of a half-space with a box");
    constexpr double rounding = 1e-6;
    const Span span{std::ceil((low - anchor) / spacing_ - 0.5 - rounding), std::floor((high - anchor) / spacing_ - 0.5 + rounding)};
    if (span.count() > most_sites_along_an_axis)
      throw std::invalid_argument("spacing is too small for this shape: more than 2^31 sites along an axis");
    return span;
  }

  double spacing_;
  const Shape& shape_;
  Vec3 anchor_;
  Boundary boundary_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Cubic>(); }
