// An engine carries bytes and whole numbers between the processes that run one scene together. A
// scene never names one: the program takes an engine if a launcher such as mpirun started it.
//
//   class Mpi {
//    public:
//     struct Options {};
//     static Schema<Options> schema();
//     explicit Mpi(const Options&);
//     EngineFacts join();
//     void exchange(std::span<const OutgoingBytes> out, std::span<const IncomingBytes> in);
//     ...
//   };
//
// Engines combine whole numbers only, because sums of floating-point numbers depend on their order.
#pragma once

#include <hyperlattice/component.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace hyperlattice {

/// The place of this process among those that run a scene together.
struct EngineFacts {
  std::int32_t rank = 0;        ///< number of this process, from 0
  std::int32_t ranks = 1;       ///< number of processes
  std::int32_t node_ranks = 1;  ///< number of processes on this machine
};

/// Bytes for another rank.
struct OutgoingBytes {
  std::int32_t rank = 0;
  std::span<const std::byte> bytes;
};
/// Where the bytes of another rank are to be stored; their number is known before.
struct IncomingBytes {
  std::int32_t rank = 0;
  std::span<std::byte> bytes;
};

/// Functions of an engine across the boundary. One thread of each process calls them. All ranks
/// call each function but join() and abort() in the same order.
struct EngineFunctions {
  /// Joins the other processes; called once, before all others.
  bool (*join)(void* engine, EngineFacts& facts, const Complaint& why) noexcept;
  /// Sends and receives. At most one message goes from a rank to another in one call.
  bool (*exchange)(void* engine, std::span<const OutgoingBytes> out,
                   std::span<const IncomingBytes> in, const Complaint& why) noexcept;
  /// Replaces each number by the largest of all ranks.
  bool (*largest)(void* engine, std::span<std::int64_t> numbers, const Complaint& why) noexcept;
  /// Replaces each number by the sum of all ranks.
  bool (*sum)(void* engine, std::span<std::int64_t> numbers, const Complaint& why) noexcept;
  /// Copies the bytes of one rank to all others.
  bool (*spread)(void* engine, std::int32_t from, std::span<std::byte> bytes,
                 const Complaint& why) noexcept;
  /// Ends all processes with this exit code. For a rank that cannot tell the others why it ends.
  void (*abort)(void* engine, std::int32_t exit_code) noexcept;
};

/// An engine class has these members; they throw if they fail.
template <class T>
concept EngineComponent = requires(T& engine, std::span<const OutgoingBytes> out,
                                   std::span<const IncomingBytes> in,
                                   std::span<std::int64_t> numbers, std::span<std::byte> bytes,
                                   std::int32_t number) {
  { engine.join() } -> std::convertible_to<EngineFacts>;
  engine.exchange(out, in);
  engine.largest(numbers);
  engine.sum(numbers);
  engine.spread(number, bytes);
  engine.abort(number);
};

namespace detail {
template <EngineComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::engines;
  static T& of(void* engine) { return *static_cast<T*>(engine); }
  static constexpr EngineFunctions table{
      [](void* engine, EngineFacts& facts, const Complaint& why) noexcept {
        return guarded(why, [&] { facts = of(engine).join(); });
      },
      [](void* engine, std::span<const OutgoingBytes> out, std::span<const IncomingBytes> in,
         const Complaint& why) noexcept {
        return guarded(why, [&] { of(engine).exchange(out, in); });
      },
      [](void* engine, std::span<std::int64_t> numbers, const Complaint& why) noexcept {
        return guarded(why, [&] { of(engine).largest(numbers); });
      },
      [](void* engine, std::span<std::int64_t> numbers, const Complaint& why) noexcept {
        return guarded(why, [&] { of(engine).sum(numbers); });
      },
      [](void* engine, std::int32_t from, std::span<std::byte> bytes,
         const Complaint& why) noexcept {
        return guarded(why, [&] { of(engine).spread(from, bytes); });
      },
      [](void* engine, std::int32_t exit_code) noexcept { of(engine).abort(exit_code); }};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
