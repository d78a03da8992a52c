// The virtual uniaxial compression test: elastic constants measured on a cube of particles as one
// would in a laboratory (Zhao 2017, section 2.3 and figure 2). The cube is an ordinary scene, run
// by the ordinary runtime.
#pragma once

#include <host/host.hpp>
#include <plan/threads.hpp>

#include <hyperlattice/calibration.hpp>

#include <string>

namespace hyperlattice {

/// Elastic constants as an experiment or the infinite lattice has them, along [100].
struct ElasticPair {
  double poisson = 0;  ///< nu
  double modulus_ratio =
      0;  ///< eta: E over that of the lattice without a membrane, of the same base springs
};

struct Measured : ElasticPair {
  double young = 0;              ///< E l / k, with the area of N^2 cells
  std::uint64_t particles = 0;   ///< of the cube
  double residual = 0;           ///< see RestReport
  std::uint64_t iterations = 0;  ///< of the static solver
  double seconds = 0;            ///< building and running
};

/// A cube of N^3 cells between frictionless platens: only the axial displacement of the two end
/// layers is prescribed. nu is the mean outward displacement of the lateral faces over the mean
/// inward one of the end faces, all over all particles of a face.
class VirtualTest {
 public:
  /// Types of what the scene is made of besides the lattice.
  struct Components {
    std::string material;      ///< an elastic solid: young, density, membrane free with k_alpha,
                               ///< k_beta, k_gamma
    std::string displacement;  ///< a load that leads particles: on, value, axes, rise
    std::string solver;        ///< finds a state of rest: tolerance, most_cutbacks, stability
  };
  struct Options {
    std::string lattice;  ///< its type
    int particles =
        20;  ///< N, along an edge; of lattices with several particles in a cubic cell, cells
    double strain = 1e-3;  ///< by which the platens shorten the distance of the end layers: (N - 1)
                           ///< l in the cubic lattice
    double residual = 1e-8;  ///< at which the cube counts as at rest
    Threads threads = 1;
  };

  /// Measures the lattice without a membrane, to compare others with. Throws as read_scene and
  /// build_model do; RunError if a cube does not come to rest.
  VirtualTest(Host& host, Components components, Options options);

  Measured measure(const calibration::Ratios& ratios);

 private:
  std::string scene(const calibration::Ratios& ratios, double shortening) const;
  double length_at_rest() const;
  Measured compress(const calibration::Ratios& ratios);

  Host& host_;
  Components components_;
  Options options_;
  double length_;
  double base_young_;
};

}  // namespace hyperlattice
