// Curves of lattices that differ in one option: the Poisson ratio against lambda, figure 3 of Zhao
// 2017 for random lattices of several coordinations.
#pragma once

#include <analyze/calibration_curve.hpp>

namespace hyperlattice {

struct CurveFamily {
  std::string option;  ///< of the lattice
  struct Member {
    std::string value;
    Curve curve;
  };
  std::vector<Member> members;
};

Json family_json(const CurveFamily& family, const VirtualTest::Options& options);
std::string family_text(const CurveFamily& family);
std::string family_script(const CurveFamily& family);  ///< the picture, in gnuplot's commands

}  // namespace hyperlattice
