// The waves of the infinite lattice give no bound for a body of cells: at edges and corners a
// particle has less mass, while the springs, which do not pull from all sides, support each other
// less. A single free cell gives a bound, and iteration over the cells the frequency itself.
#include <model/critical_step.hpp>
#include <model/iterated_frequency.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <Eigen/Dense>

namespace hyperlattice {

namespace {

constexpr int corners = 8;
using Membrane = KernelChoice::Membrane;

int number(Site s) { return s.i + 2 * s.j + 4 * s.k; }

int size_of(const Model& model) { return model.springs.choice.membrane == Membrane::free ? 4 : 3; }

/// Returns the stiffness matrix of one cell, N/m, with its share of the springs; by corner, then by
/// component.
Eigen::MatrixXd stiffness_of_cell(const Model& model, std::uint8_t material) {
  const int size = size_of(model);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(corners * size, corners * size);
  const auto add = [&](int a, int b, double k, Vec3 r, double height, double length) {
    // Derivatives of the spring's length by the displacements.
    Eigen::VectorXd growth = Eigen::VectorXd::Zero(corners * size);
    growth.segment<3>(size * b) = Eigen::Vector3d(r.x, r.y, r.z) / length;
    growth.segment<3>(size * a) = -growth.segment<3>(size * b);
    if (size == 4) growth(size * a + 3) = growth(size * b + 3) = height / length;
    stiffness += k * growth * growth.transpose();
  };
  for (const NeighbourGeometry& n : model.springs.neighbours) {
    int cells = 0;  // number of cells of a spring
    for_cells_of(n.site, [&](int, int, int) { ++cells; });
    for_cells_of(n.site, [&](int di, int dj, int dk) {
      const int a = number({-di, -dj, -dk}),
                b = number({n.site.dx - di, n.site.dy - dj, n.site.dz - dk});
      const SpringConstants& spring = model.springs.spring(material, material, n.site.spring_class);
      add(a, b, spring.stiffness / cells, n.rest, 0, n.rest_length);
      if (model.springs.choice.membrane != Membrane::none)
        add(a, b, spring.cross_stiffness / cells, n.rest, model.body.grid.membrane_distance,
            n.cross_rest_length);
    });
  }
  Eigen::VectorXd growth = Eigen::VectorXd::Zero(corners * size);  // of the volume, times 4 l
  for (std::size_t corner = 0; corner < corners; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      growth(static_cast<Eigen::Index>(corner) * size + static_cast<Eigen::Index>(axis)) =
          corner_sign(corner, axis);
  stiffness += model.materials[material].constants.volumetric * model.body.grid.spacing / 16 *
               growth * growth.transpose();
  for (int n = 0; n < corners && size == 4; ++n)
    stiffness(size * n + 3, size * n + 3) += 2 * model.kinds.alphas[material] / corners;
  return stiffness;
}

/// The product of M^-1/2 K M^-1/2 of a body of cells and a vector, [particle][component].
class ScaledStiffness {
 public:
  explicit ScaledStiffness(const Model& model) : model_(model), size_(size_of(model)) {
    for (std::size_t n = 0; n < model.materials.size(); ++n)
      of_material_.push_back(stiffness_of_cell(model, static_cast<std::uint8_t>(n)));
    scale_.resize(numbers());
    for (Particle p = 0; p < model.body.particles; ++p)
      scale_.segment(first(p), size_).setConstant(1 / std::sqrt(model.mass(p)));
  }
  Eigen::Index numbers() const { return first(model_.body.particles); }

  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd moved = scale_.cwiseProduct(x);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(numbers());
    Eigen::VectorXd of_cell(corners * size_), pull(corners * size_);
    auto partial = model_.body.cells.partial().begin();  // the next one
    for (const Run& run : model_.body.cells.runs()) {
      Particle row[4];  // the particles at the run's first cell; those of the next cells follow
      for (std::int32_t n = 0; n < 4; ++n)
        row[n] = model_.body.at({run.begin, run.j + (n & 1), run.k + (n >> 1)});
      for (std::int32_t i = run.begin; i < run.end; ++i) {
        const auto at = [&](int corner) {
          return first(row[corner >> 1] + static_cast<Particle>(i - run.begin + (corner & 1)));
        };
        const std::uint8_t material =
            model_.kinds.mixtures.empty()
                ? std::uint8_t{0}
                : model_.kinds.mixtures.cell_above(
                      model_.kinds.mixtures.of(row[0] + static_cast<Particle>(i - run.begin)));
        for (int n = 0; n < corners; ++n)
          of_cell.segment(n * size_, size_) = moved.segment(at(n), size_);
        pull.noalias() = of_material_[material] * of_cell;
        if (partial != model_.body.cells.partial().end() &&
            partial->cell == run.first + static_cast<Particle>(i - run.begin))
          pull *= double{(partial++)->share};
        for (int n = 0; n < corners; ++n)
          force.segment(at(n), size_) += pull.segment(n * size_, size_);
      }
    }
    return scale_.cwiseProduct(force);
  }

 private:
  Eigen::Index first(Particle particle) const {
    return static_cast<Eigen::Index>(particle) * size_;
  }

  const Model& model_;
  int size_;
  std::vector<Eigen::MatrixXd> of_material_;
  Eigen::VectorXd scale_;  // M^-1/2
};

}  // namespace

double cell_bound(const Model& model, std::uint8_t material) {
  const Eigen::MatrixXd stiffness =
      corners / model.kinds.masses[material] * stiffness_of_cell(model, material);
  return numerics::SymmetricEigen<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

double cell_bound(const Model& model) {
  double largest = 0;
  for (std::size_t material = 0; material < model.materials.size(); ++material)
    largest = std::max(largest, cell_bound(model, static_cast<std::uint8_t>(material)));
  return largest;
}

double iterated_frequency(const Model& model) {
  const ScaledStiffness stiffness(model);
  return frequency_by_iteration(stiffness.numbers(),
                                [&](const Eigen::VectorXd& x) { return stiffness.times(x); });
}

}  // namespace hyperlattice
