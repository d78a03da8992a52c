// The processes that run one scene together, one rank each. All ranks do the same in the same
// order; each computes its own blocks, and the first one writes the files. An engine carries what
// they exchange. Without an engine a process is alone, and nothing here costs anything.
#pragma once

#include <base/errors.hpp>
#include <host/host.hpp>

#include <hyperlattice/engine.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hyperlattice {

/// What a rank asks of all; it is done once all have agreed, at the next meeting.
enum class Wish : std::uint8_t { stop, save };

/// The error of another rank, which ends this one too.
class OtherRankError : public std::runtime_error {
 public:
  OtherRankError(int exit_code, const std::string& reason)
      : std::runtime_error(reason), exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

class Ranks {
 public:
  /// This process alone.
  Ranks() = default;
  /// Returns an object for all that needs to know of no other process.
  static Ranks& alone();
  /// Joins the other processes through an engine. Throws OutsideError if it cannot.
  explicit Ranks(const Component& engine);
  /// A rank that ends by an error of which the others do not know ends them too.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return facts_.rank; }
  int count() const { return facts_.ranks; }
  /// Returns the number of ranks on this machine.
  int on_node() const { return facts_.node_ranks; }
  /// Returns whether this rank writes the files and messages.
  bool is_first() const { return facts_.rank == 0; }
  /// Returns whether this rank acts without the others.
  bool is_alone() const { return facts_.ranks == 1 || solo_; }

  /// Lets this rank act without the others, for the lifetime of the object.
  class Solo {
   public:
    explicit Solo(Ranks& ranks) : ranks_(ranks), before_(ranks.solo_) { ranks.solo_ = true; }
    ~Solo() { ranks_.solo_ = before_; }
    Solo(const Solo&) = delete;
    Solo& operator=(const Solo&) = delete;

   private:
    Ranks& ranks_;
    bool before_;
  };

  /// Places of the program where the ranks meet.
  enum class Meeting : std::int64_t {
    end,
    start,
    step,
    state,
    results,
    failures,
    speed,
    stage,
    loads,
    damage
  };
  /// Waits until all ranks are here, and returns the largest of their numbers. Wishes are then
  /// agreed. Throws OtherRankError if another rank has failed instead of coming here.
  std::int64_t meet(Meeting place, std::int64_t number = 0);
  /// Does work that all ranks do, and meets them at its end. Throws the error of the lowest rank
  /// whose work failed: its own type of exception in that rank, OtherRankError in the others.
  template <class Work>
  void together(const Work& work);

  /// Asks all ranks for something.
  void wish(Wish what) { wishes_[index(what)] = 1; }
  /// Returns whether all ranks have agreed on a wish.
  bool agreed(Wish what) const { return (is_alone() ? wishes_ : agreed_)[index(what)] != 0; }
  /// Withdraws a wish that was done.
  void done(Wish what) { wishes_[index(what)] = agreed_[index(what)] = 0; }

  // What engines do. Only after a meeting, because a rank that fails comes to meetings only.
  void exchange(std::span<const OutgoingBytes> out, std::span<const IncomingBytes> in);
  void largest(std::span<std::int64_t> numbers);
  void sum(std::span<std::int64_t> numbers);
  void spread(int from, std::span<std::byte> bytes);

 private:
  static std::size_t index(Wish what) { return static_cast<std::size_t>(what); }
  struct Failure {
    int exit_code = exit_done;
    std::string reason;
  };
  template <class Function, class... Arguments>
  void call(const char* name, Function function, Arguments&&... arguments);
  std::int64_t meet(Meeting place, std::int64_t number, const Failure& mine);
  static Failure failure_of(const std::exception& error);
  void end_work(const Failure& mine);

  const Component* engine_ = nullptr;
  std::unique_ptr<void, void (*)(void*)> made_{nullptr, nullptr};
  EngineFacts facts_;
  std::array<std::int64_t, 2> wishes_{}, agreed_{};
  bool solo_ = false;
  bool failed_together_ = false;  ///< all ranks know of the error that ends this one
};

template <class Work>
void Ranks::together(const Work& work) {
  if (is_alone()) return work();
  try {
    work();
  } catch (const OtherRankError&) {
    throw;
  } catch (const std::exception& error) {
    end_work(failure_of(error));
    throw;
  }
  end_work({});
}

}  // namespace hyperlattice
