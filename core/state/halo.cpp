#include <model/array_criterion.hpp>
#include <model/nodal_volumes.hpp>
#include <state/halo.hpp>

#include <algorithm>
#include <cstring>

namespace hyperlattice {

std::vector<int> owners_of(std::size_t blocks, int ranks) {
  std::vector<int> owners;
  for (std::size_t b = 0; b < blocks; ++b)
    owners.push_back(static_cast<int>(b * static_cast<std::size_t>(ranks) / blocks));
  return owners;
}

std::string needs_whole(const Model& model) {
  if (model.nodal_volumes) return "pressures follow from the volumes around all particles";
  for (const Material& material : model.materials)
    if (has_array_criterion(material))
      return "a failure criterion decides about all springs at once";
  return "";
}

Halo::Halo(const Model& model, const Layout& layout, const std::vector<int>& owners, int rank)
    : components_(model.degrees_of_freedom), number_(bytes_of(model.springs.choice.precision)) {
  const bool may_lose = model.springs.breakable || model.springs.softens;
  // The energy of a broken spring needs the velocities of both its ends.
  has_velocities_ = model.springs.asks_rate || may_lose;
  has_springs_ = may_lose && !model.body.is_listed();  // both ends of a list know their springs
  for (std::size_t block = 0; block < owners.size(); ++block)
    for (const Layout::Borrowed& range : layout.borrowed(block)) {
      const int from = owners[range.block], to = owners[block];
      if (from == to) continue;
      if (from == rank) peers_[to].sent.push_back(range);
      if (to == rank) peers_[from].received.push_back(range);
    }
  for (auto& [other, peer] : peers_) {
    for (std::vector<Layout::Borrowed>* ranges : {&peer.sent, &peer.received}) {
      std::sort(ranges->begin(), ranges->end());
      ranges->erase(std::unique(ranges->begin(), ranges->end()), ranges->end());
    }
    peer.out.resize(size_of(peer.sent));
    peer.in.resize(size_of(peer.received));
  }
}

std::size_t Halo::size_of(const std::vector<Layout::Borrowed>& ranges) const {
  const std::size_t numbers =
      static_cast<std::size_t>(components_) * (has_velocities_ ? 2 : 1) * number_;
  std::size_t size = 0;
  for (const Layout::Borrowed& range : ranges)
    size += (range.end - range.begin) * (numbers + (has_springs_ ? sizeof(std::uint16_t) : 0));
  return size;
}

std::size_t Halo::bytes_sent() const {
  std::size_t bytes = 0;
  for (const auto& [rank, peer] : peers_) bytes += peer.out.size();
  return bytes;
}

/// Calls visit(bytes) for the parts of a range of rows that are exchanged.
template <class Visit>
void Halo::for_bytes(const Block& block, const Layout::Borrowed& range, const Visit& visit) const {
  const std::size_t count = range.end - range.begin;
  const auto numbers = [&](const Numbers& field) {
    visit(field.bytes().subspan(range.begin * number_, count * number_));
  };
  for (int c = 0; c < components_; ++c) {
    numbers(block.displacement[c]);
    if (has_velocities_) numbers(block.velocity[c]);
  }
  if (has_springs_)
    visit(std::as_writable_bytes(std::span(block.alive.get() + range.begin, count)));
}

void Halo::exchange(std::vector<Block>& blocks, Ranks& ranks) {
  std::vector<OutgoingBytes> out;
  std::vector<IncomingBytes> in;
  for (auto& [rank, peer] : peers_) {
    std::byte* to = peer.out.data();
    for (const Layout::Borrowed& range : peer.sent)
      for_bytes(blocks[range.block], range, [&](std::span<const std::byte> bytes) {
        std::memcpy(to, bytes.data(), bytes.size());
        to += bytes.size();
      });
    out.push_back({rank, peer.out});
    in.push_back({rank, peer.in});
  }
  ranks.exchange(out, in);
  for (auto& [rank, peer] : peers_) {
    const std::byte* from = peer.in.data();
    for (const Layout::Borrowed& range : peer.received)
      for_bytes(blocks[range.block], range, [&](std::span<std::byte> bytes) {
        std::memcpy(bytes.data(), from, bytes.size());
        from += bytes.size();
      });
  }
}

}  // namespace hyperlattice
