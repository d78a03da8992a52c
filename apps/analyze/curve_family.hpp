// Calibration curves (Poisson ratio against lambda) of lattices that differ in one option, as in
// figure 3 of Zhao 2017 for random lattices of several coordinations.
#pragma once

#include <analyze/calibration_curve.hpp>

namespace hyperlattice {

/// One calibration curve for each value of an option.
struct CurveFamily {
  std::string option;  ///< name of the lattice's option
  struct Member {
    std::string value;
    Curve curve;
  };
  std::vector<Member> members;
};

Json family_json(const CurveFamily& family, const VirtualTest::Options& options);
std::string family_text(const CurveFamily& family);
std::string family_script(const CurveFamily& family);  ///< the picture as gnuplot commands

}  // namespace hyperlattice
