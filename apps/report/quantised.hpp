// Numbers as whole numbers of 16 bits, for the page with the body in 3D.
#pragma once

#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice::report {

/// Arrays of 16-bit numbers, one behind the other. The number q from 0 to 65534 of an array means
/// min + q (max - min) / 65534, so that its error is at most half such a step; 65535 means a number
/// that is not finite. apps/report/viewer/data.js reads them.
class QuantisedNumbers {
 public:
  /// Adds component `part` of values with `components` numbers each. Returns where they are: the
  /// object {min, max, at}, with null for min and max if no number is finite. Numbers that equal
  /// those at `before`, an object of an earlier call or null, are not added again.
  Json add(std::span<const double> values, std::size_t components, std::size_t part,
           const Json& before = nullptr);

  /// Returns the numbers as bytes, the low byte first.
  std::string bytes() const;

 private:
  std::vector<std::uint16_t> numbers_;
};

}  // namespace hyperlattice::report
