// The contract of engines: numbers and bytes of all ranks are combined and copied. Without a
// launcher there is one rank; `mpirun -n 3 hyperlattice plugins --test engines.mpi` checks several.
#include <contract/families.hpp>
#include <ranks/ranks.hpp>

#include <spdlog/fmt/fmt.h>

#include <array>

namespace hyperlattice::contract {
namespace {

/// Returns the sum of 1 + rank over all ranks.
std::int64_t sum_of_all(std::int64_t ranks) { return ranks * (ranks + 1) / 2; }

/// Sends to each other rank its own number, and returns whether theirs arrive.
bool passes_messages(Ranks& ranks) {
  const auto own = static_cast<std::byte>(ranks.rank() + 1);
  std::vector<std::byte> found(static_cast<std::size_t>(ranks.count()));
  std::vector<OutgoingBytes> out;
  std::vector<IncomingBytes> in;
  for (int rank = 0; rank < ranks.count(); ++rank)
    if (rank != ranks.rank()) {
      out.push_back({rank, {&own, 1}});
      in.push_back({rank, {&found[static_cast<std::size_t>(rank)], 1}});
    }
  ranks.exchange(out, in);
  for (int rank = 0; rank < ranks.count(); ++rank)
    if (rank != ranks.rank() &&
        found[static_cast<std::size_t>(rank)] != static_cast<std::byte>(rank + 1))
      return false;
  return true;
}

}  // namespace

void check_engine(Trial& trial) {
  std::optional<Ranks> ranks;
  trial.check("joins", [&] {
    ranks.emplace(trial.component);
    return passes_if(ranks->count() >= 1 && ranks->rank() >= 0 && ranks->rank() < ranks->count(),
                     fmt::format("rank {} of {}", ranks->rank(), ranks->count()));
  });
  if (!ranks) return;
  trial.check("combines numbers", [&] {
    std::array<std::int64_t, 2> largest{ranks->rank(), -ranks->rank()}, sum{1 + ranks->rank(), 0};
    ranks->largest(largest);
    ranks->sum(sum);
    return passes_if(
        largest[0] == ranks->count() - 1 && largest[1] == 0 && sum[0] == sum_of_all(ranks->count()),
        "the largest and the sum of whole numbers");
  });
  trial.check("spreads bytes", [&] {
    std::array<std::byte, 3> bytes{};
    const int last = ranks->count() - 1;
    if (ranks->rank() == last) bytes.fill(std::byte{7});
    ranks->spread(last, bytes);
    return passes_if(bytes[0] == std::byte{7} && bytes[2] == std::byte{7}, "of the last rank");
  });
  trial.check("passes messages",
              [&] { return passes_if(passes_messages(*ranks), "from each rank to each other"); });
}

}  // namespace hyperlattice::contract
