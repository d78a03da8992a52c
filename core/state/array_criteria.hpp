// The failure criteria that decide about all springs at once (array_failure.hpp). They are asked
// before the kernels run, and the review of springs then looks their answers up.
#pragma once

#include <state/alarmed_springs.hpp>
#include <state/clock.hpp>

#include <hyperlattice/array_failure.hpp>

#include <utility>
#include <vector>

namespace hyperlattice {

class ArrayCriteria {
 public:
  ArrayCriteria(const BlockSet& blocks, const Clock& clock);

  bool empty() const { return criteria_.empty(); }
  /// Asks each criterion about all springs above its alarm, in the present state, with `part` of
  /// their elongations. The blocks know their neighbours (BlockSet::exchange).
  void ask(double part = 1);
  /// Returns the last answer of a criterion about the spring between a and b, with a < b. `number`:
  /// see Material::Criterion. A spring about which it was not asked holds.
  bool breaks(std::uint32_t number, Particle a, Particle b) const;

 private:
  /// The arrays of a SpringArrays.
  struct Arrays {
    std::vector<double> elongation, rest_length, stiffness, rate;
    std::vector<std::uint32_t> spring_class;
    std::vector<Particle> a, b;

    void append(const Arrays& others);
    void sort_by_ends();
  };
  using Ends = std::pair<Particle, Particle>;
  struct Asked {
    const Material::Criterion* criterion = nullptr;
    const ArrayFailureFunctions* functions = nullptr;
    std::uint8_t material = 0;
    std::vector<Ends> broken;  ///< in ascending order
  };

  Arrays springs_of(const Asked& asked, const Block& block,
                    const std::vector<AlarmedPlace>& alarmed) const;
  double rate(const SpringEnds& spring, const Vec3& rest) const;
  void ask(Asked& asked, const std::vector<std::vector<AlarmedPlace>>& alarmed) const;

  const BlockSet& blocks_;
  const Model& model_;
  const Clock& clock_;
  std::vector<Asked> criteria_;
};

}  // namespace hyperlattice
