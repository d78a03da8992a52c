// One block of the state: its arrays, its supports, and the breakages of the step that is under way.
#pragma once

#include <run/layout.hpp>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace hyperlattice {

/// Zeros in memory aligned to cache lines, written first by the thread that makes the array: that thread's memory holds it.
template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) : data_(static_cast<T*>(::operator new[](size * sizeof(T), std::align_val_t{64}))), size_(size) {
    std::uninitialized_fill_n(data_.get(), size, T{});
  }
  T* get() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t n) const { return data_.get()[n]; }

 private:
  struct Free {
    void operator()(T* data) const { ::operator delete[](data, std::align_val_t{64}); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

/// A load's part in a support.
struct Contribution {
  std::uint32_t support = 0, load = 0;
  Particle particle = 0;
  Vec3 force, displacement, velocity;  ///< amplitudes
  Axes displaced = 0, driven = 0;
  double factor = 0;  ///< of the present step
  double work = 0;    ///< of the force since the start, J
};

/// What a block of a listed body has besides; see ListedSlots.
struct ListedArrays {
  AlignedArray<std::uint32_t> first, neighbour;
  AlignedArray<double> stiffness, alarm, rest, around, shares;
};

struct Block {
  const BlockLayout* layout = nullptr;
  std::size_t number = 0;  ///< its place among the blocks
  std::vector<Row> rows;   ///< the layout's, with their supports
  AlignedArray<double> displacement[4], velocity[4];
  AlignedArray<std::uint16_t> alive;
  AlignedArray<std::uint8_t> material;
  AlignedArray<double> scratch;
  ListedArrays listed;
  std::vector<double> damped_work;  ///< a row
  std::vector<RowSums> sums;        ///< a row
  std::vector<Support> supports;    ///< in the rows' order
  std::vector<Contribution> contributions;

  struct Broken {
    SpringEnds spring;
    double elongation;
  };
  std::vector<Broken> broken;         ///< in this step, by row, neighbour, site
  std::vector<std::uint8_t> answers;  ///< of the failure criterion, for one batch
};

}  // namespace hyperlattice
