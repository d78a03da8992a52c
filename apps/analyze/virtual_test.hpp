// The virtual uniaxial compression test: elastic constants from a compressed cube of particles
// (Zhao 2017, section 2.3 and figure 2). The cube is a normal scene in the normal runtime.
#pragma once

#include <host/host.hpp>
#include <plan/threads.hpp>

#include <hyperlattice/calibration.hpp>

#include <optional>
#include <string>

namespace hyperlattice {

/// Elastic constants along [100], of the infinite lattice or of a test.
struct ElasticPair {
  double poisson = 0;  ///< nu
  /// eta: E over the E of the lattice with the same base springs and no membrane.
  double modulus_ratio = 0;
};

/// The result of a test.
struct VirtualTestResult : ElasticPair {
  double young = 0;              ///< E l / k, for the area of N^2 cells
  std::uint64_t particles = 0;   ///< of the cube
  double residual = 0;           ///< see RestReport
  std::uint64_t iterations = 0;  ///< of the static solver
  double seconds = 0;            ///< wall time to build and run the cube, s
};

/// Compresses a cube of N^3 cells between frictionless platens: only the axial displacement of the
/// two end layers is prescribed. nu is the mean outward displacement of the lateral faces over the
/// mean inward displacement of the end faces; each mean is over all particles of a face.
class VirtualTest {
 public:
  /// The types of the components in the scene, besides the lattice.
  struct Components {
    std::string material;  ///< an elastic solid; options: young, density, membrane free with
                           ///< k_alpha, k_beta, k_gamma; membrane none with poisson, volumetric
    /// A load with a prescribed displacement; options: on, value, axes, rise.
    std::string displacement;
    std::string solver;  ///< finds a state of rest; options: tolerance, most_cutbacks, stability
  };
  struct Options {
    std::string lattice;  ///< type of the lattice component
    /// N along an edge; cells, if a cubic cell of the lattice has several particles.
    int particles = 20;
    /// Shortening over the distance of the end layers, which is (N - 1) l in the cubic lattice.
    double strain = 1e-3;
    double residual = 1e-8;  ///< the cube is at rest below this residual, see RestReport
    Threads threads = 1;
  };

  /// Measures the lattice without a membrane, as the reference for eta. Throws as read_scene and
  /// build_model do; RunError if a cube finds no state of rest.
  VirtualTest(Host& host, Components components, Options options);

  /// Measures the lattice with these stiffness ratios. `poisson`: in place of ratios, the Poisson
  /// ratio that the volumetric energy gives the lattice without a membrane. Throws RunError if the
  /// cube finds no state of rest.
  VirtualTestResult measure(const calibration::Ratios& ratios, std::optional<double> poisson = {});

 private:
  std::string scene(const calibration::Ratios& ratios, std::optional<double> poisson,
                    double shortening) const;
  double length_at_rest() const;
  VirtualTestResult compress(const calibration::Ratios& ratios, std::optional<double> poisson);

  Host& host_;
  Components components_;
  Options options_;
  double length_;
  double base_young_;
};

}  // namespace hyperlattice
