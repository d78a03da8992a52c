// Stability and the critical time step of central differences, 2 / omega_max, from the waves of the
// lattice.
#pragma once

#include <model/waves.hpp>

namespace hyperlattice {

/// Upper bound of m omega^2 for any body of springs: twice the largest eigenvalue of the sum of |k|
/// n n^T over the springs of a particle, with unit vectors n in four dimensions. It holds because
/// (n.a - n.b)^2 <= 2 (n.a)^2 + 2 (n.b)^2 for every spring.
class StiffnessBound {
 public:
  /// Adds the base spring and the cross springs from the particle to a neighbour (side 1) or to the
  /// neighbour on the opposite side (side -1).
  void add(const NeighbourGeometry& neighbour, int side, const SpringConstants& spring,
           double membrane_distance, KernelChoice::Membrane membrane);
  void add_alpha(double alpha);  ///< N/m
  /// Adds `stiffness` n n^T / 2, N/m, with the direction n of a vector: the part of this particle
  /// in an energy of several.
  void add_part(double stiffness, Vec3 vector);
  double value() const;  ///< N/m

 private:
  double sum_[10] = {};  // lower triangle of the 4 x 4 matrix, by rows
};

/// Returns an upper bound of omega^2, 1/s2, for a body of cells. Stiffness and mass are sums over
/// the cells, so for any motion u.K.u / u.M.u is at most the largest value of a single free cell.
/// The bound is exact for a body of one cell.
double cell_bound(const Model& model);
/// Returns omega^2, 1/s2, of the stiffest motion of one free cell of a material, with its share of
/// the springs and of the masses.
double cell_bound(const Model& model, std::uint8_t material);
/// Returns the largest frequency omega, 1/s, of a body of cells from 25 steps of Lanczos's method
/// (Golub and Van Loan 2013, section 10.1), increased by 2 %: they find it from below. Costs as
/// much as some hundred time steps.
double iterated_frequency(const Model& model);

/// Upper bound of omega^2 for a listed body: the largest StiffnessBound of a particle over its
/// mass. The volumetric energy of a particle, with the gradients g of its volume V by the places of
/// the particles around it, adds K_v / V (sum |g_b|) g_a g_a^T / |g_a| to particle a, because
///   (sum g_a.x_a)^2 <= (sum |g_b|) sum (g_a.x_a)^2 / |g_a|.
struct ListedBound {
  double square = 0;  ///< omega^2, 1/s2
  Particle particle = 0;
  bool all_positive = true;  ///< no spring has a negative stiffness: the body is stable
};
ListedBound listed_bound(const Model& model);
/// Returns that StiffnessBound of each particle, N/m.
std::vector<double> listed_bounds(const Model& model);
/// Returns the largest frequency omega, 1/s, of a listed body with volumetric energies and without
/// a membrane, as iterated_frequency() does for cells. The bound is about twice as large.
double iterated_frequency_of_list(const Model& model);

/// Returns the stable step, s, that laws leave of `elastic`, s, the stable step of their springs
/// alone: shorter if a law is not purely elastic.
double stable_step_of_laws(const Model& model, double elastic);

/// Sets the model's critical time step and the sentence about what limits it: exact for one
/// material and whole particles, a safe bound otherwise. Adds a fault for each unstable material,
/// unless the scene allows unstable ones.
void find_critical_step(Model& model, Faults& faults);

}  // namespace hyperlattice
