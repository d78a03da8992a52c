// Several processes for one run, by MPI: `mpirun -n 4 hyperlattice run scene.json`.
//
// Messages between two ranks are sent and received without waiting, all at once. Messages above
// 1 GiB are cut, because MPI counts in 32 bits. Any error of MPI ends all ranks, which is what MPI
// does by itself.
#include <hyperlattice/engine.hpp>

#include <mpi.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace hyperlattice {
namespace {

constexpr std::size_t longest = std::size_t{1} << 30;  // bytes of one message

/// Calls visit(first byte, number of bytes) for pieces that MPI can count.
template <class Visit>
void for_pieces(std::size_t size, const Visit& visit) {
  for (std::size_t done = 0; done < size; done += longest)
    visit(done, static_cast<int>(std::min(longest, size - done)));
}

}  // namespace

class Mpi {
 public:
  struct Options {};

  static Schema<Options> schema() {
    return Schema<Options>("engines.mpi", "Several processes for one run, by MPI")
        .source("Message Passing Interface Forum, MPI: A Message-Passing Interface Standard, 3.1")
        .restrictions(
            "A scene does not name it: the program takes it if mpirun or srun started several "
            "processes.");
  }

  explicit Mpi(const Options&) {}
  ~Mpi() {
    int finished = 0;
    if (joined_ && MPI_Finalized(&finished) == MPI_SUCCESS && finished == 0) MPI_Finalize();
  }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;

  EngineFacts join() {
    int initialized = 0, given = 0;
    MPI_Initialized(&initialized);
    if (initialized != 0) throw std::runtime_error("MPI is in use in this process already");
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    joined_ = true;
    if (given < MPI_THREAD_FUNNELED)
      throw std::runtime_error("this MPI library does not allow threads (MPI_THREAD_FUNNELED)");
    MPI_Comm node;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    EngineFacts facts;
    MPI_Comm_rank(MPI_COMM_WORLD, &facts.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &facts.ranks);
    MPI_Comm_size(node, &facts.node_ranks);
    MPI_Comm_free(&node);
    return facts;
  }

  void exchange(std::span<const OutgoingBytes> out, std::span<const IncomingBytes> in) {
    requests_.clear();
    for (const IncomingBytes& message : in)
      for_pieces(message.bytes.size(), [&](std::size_t first, int size) {
        MPI_Irecv(message.bytes.data() + first, size, MPI_BYTE, message.rank, 0, MPI_COMM_WORLD,
                  &requests_.emplace_back());
      });
    for (const OutgoingBytes& message : out)
      for_pieces(message.bytes.size(), [&](std::size_t first, int size) {
        MPI_Isend(message.bytes.data() + first, size, MPI_BYTE, message.rank, 0, MPI_COMM_WORLD,
                  &requests_.emplace_back());
      });
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }

  void largest(std::span<std::int64_t> numbers) { combine(numbers, MPI_MAX); }
  void sum(std::span<std::int64_t> numbers) { combine(numbers, MPI_SUM); }

  void spread(std::int32_t from, std::span<std::byte> bytes) {
    for_pieces(bytes.size(), [&](std::size_t first, int size) {
      MPI_Bcast(bytes.data() + first, size, MPI_BYTE, from, MPI_COMM_WORLD);
    });
  }

  void abort(std::int32_t exit_code) { MPI_Abort(MPI_COMM_WORLD, exit_code); }

 private:
  static void combine(std::span<std::int64_t> numbers, MPI_Op how) {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_INT64_T, how,
                  MPI_COMM_WORLD);
  }

  bool joined_ = false;
  std::vector<MPI_Request> requests_;
};

}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Mpi>(); }
