// The waves of the infinite lattice give no bound for a body of cells: at edges and corners a
// particle has less mass, while the springs, which do not pull from all sides, support each other
// less.
#include <model/critical_step.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <Eigen/Dense>

namespace hyperlattice {

namespace {

constexpr int corners = 8;
using Membrane = KernelChoice::Membrane;

int number(Site s) { return s.i + 2 * s.j + 4 * s.k; }

/// Returns omega^2, 1/s2, of the stiffest motion of one free cell, with its share of the springs
/// and of the masses.
double stiffest(const Model& model, std::uint8_t material) {
  const int size = model.springs.choice.membrane == Membrane::free ? 4 : 3;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(corners * size, corners * size);
  Eigen::VectorXd mass(corners * size);
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
  mass.setConstant(model.kinds.masses[material] / corners);
  for (int n = 0; n < corners && size == 4; ++n)
    stiffness(size * n + 3, size * n + 3) += 2 * model.kinds.alphas[material] / corners;
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = root.asDiagonal() * stiffness * root.asDiagonal();
  return numerics::SymmetricEigen<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace

double cell_bound(const Model& model) {
  double largest = 0;
  for (std::size_t material = 0; material < model.materials.size(); ++material)
    largest = std::max(largest, stiffest(model, static_cast<std::uint8_t>(material)));
  return largest;
}

}  // namespace hyperlattice
