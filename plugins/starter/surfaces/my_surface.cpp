// Damage starts at a limit of the largest principal stress, which compression across it lowers:
//   ratio = (<s1> + weight <-s3>) / strength
// With weight 0 it is the limit of Rankine.
#include <hyperlattice/strength_surface.hpp>

#include <algorithm>

namespace {
using namespace hyperlattice;

class MySurface {
 public:
  struct Options : CohesiveOptions {
    double weight = 0;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("failures.my_surface",
                           "Damage that starts at a limit of the largest principal stress");
    // The options of every surface, then its own.
    return CohesiveOptions::declare(schema)
        .equation("ratio = (<s1> + weight <-s3>) / strength")
        .add<&Options::weight>("weight", "", "of compression")
        .at_least(0)
        .at_most(1)
        .fallback("0.1");
  }

  explicit MySurface(const Options& options)
      : strength_(options.strength), weight_(options.weight) {}

  // 1 on the surface. Twice the stress must have twice the ratio; a stress without danger has 0.
  double ratio(const PrincipalStress& stress) const {
    return (std::max(stress.first, 0.0) + weight_ * std::max(-stress.third, 0.0)) / strength_;
  }

 private:
  double strength_, weight_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<MySurface>(); }
