// What the ranks of a run exchange after each step: the rows of other ranks' blocks that this
// rank's blocks read, and the rows of its own that others read. They never change.
#pragma once

#include <ranks/ranks.hpp>
#include <state/block.hpp>

#include <map>
#include <string>
#include <vector>

namespace hyperlattice {

/// Returns the rank of each of so many blocks: ranges of blocks, in their order.
std::vector<int> owners_of(std::size_t blocks, int ranks);

/// Returns why a step may read or change what any block has, as a clause; "" if it does not.
std::string needs_whole(const Model& model);

class Halo {
 public:
  /// `owners`: the rank of each block; `rank`: this one.
  Halo(const Model& model, const Layout& layout, const std::vector<int>& owners, int rank);

  /// Sends the present state of own rows, and stores that of other ranks' rows in their blocks.
  void exchange(std::vector<Block>& blocks, Ranks& ranks);
  /// Returns the bytes that this rank sends in an exchange.
  std::size_t bytes_sent() const;

 private:
  /// The ranges of one other rank, in the same order in both ranks.
  struct Peer {
    std::vector<Layout::Borrowed> sent, received;
    std::vector<std::byte> out, in;
  };
  template <class Visit>
  void for_bytes(const Block& block, const Layout::Borrowed& range, const Visit& visit) const;
  std::size_t size_of(const std::vector<Layout::Borrowed>& ranges) const;

  int components_;
  bool has_velocities_, has_springs_;  ///< whether others need them
  std::size_t number_;                 ///< bytes of a number
  std::map<int, Peer> peers_;          ///< by rank
};

}  // namespace hyperlattice
