#include <host/plugin_call.hpp>
#include <ranks/ranks.hpp>

#include <spdlog/fmt/fmt.h>

#include <exception>
#include <limits>

namespace hyperlattice {
namespace {

const EngineFunctions& functions_of(const Component& engine) {
  return *static_cast<const EngineFunctions*>(engine.info.functions);
}

OutsideError failed(const Component& engine, const char* function, std::string_view sentence) {
  return plugin_failure(engine.info.name, {}, engine.path.native(), function, sentence);
}

}  // namespace

Ranks& Ranks::alone() {
  static Ranks ranks;
  return ranks;
}

Ranks::Ranks(const Component& engine) : engine_(&engine), made_(nullptr, engine.info.destroy) {
  PluginCall making(engine.info.name, engine.path.c_str(), "constructor");
  const std::unique_ptr<void, void (*)(void*)> options(engine.info.create_options(making.why()),
                                                       engine.info.destroy_options);
  if (options) made_.reset(engine.info.create(options.get(), making.why()));
  if (const std::string* sentence = making.failure(made_ != nullptr))
    throw failed(engine, "constructor", *sentence);
  call("join", functions_of(engine).join, facts_);
}

Ranks::~Ranks() {
  if (engine_ != nullptr && std::uncaught_exceptions() > 0 && !failed_together_)
    functions_of(*engine_).abort(made_.get(), exit_outside);
}

template <class Function, class... Arguments>
void Ranks::call(const char* name, Function function, Arguments&&... arguments) {
  PluginCall calling(engine_->info.name, engine_->path.c_str(), name);
  if (const std::string* sentence =
          calling.failure(function(made_.get(), arguments..., calling.why())))
    throw failed(*engine_, name, *sentence);
}

std::int64_t Ranks::meet(Meeting place, std::int64_t number) {
  return is_alone() ? number : meet(place, number, {});
}

std::int64_t Ranks::meet(Meeting place, std::int64_t number, const Failure& mine) {
  // The lowest rank that failed has the largest number. It may be anywhere.
  const bool has_failed = mine.exit_code != exit_done;
  constexpr std::int64_t anywhere = std::numeric_limits<std::int64_t>::min();
  const auto here = static_cast<std::int64_t>(place);
  std::array<std::int64_t, 6> said{has_failed ? count() - rank() : 0,
                                   has_failed ? anywhere : here,
                                   has_failed ? anywhere : -here,
                                   number,
                                   wishes_[0],
                                   wishes_[1]};
  largest(said);
  agreed_ = {said[4], said[5]};
  if (said[0] == 0) {
    if (said[1] != -said[2])
      throw std::logic_error(fmt::format(
          "the ranks of the run are at different places of the program, {} to {}: an error of "
          "Hyperlattice",
          -said[2], said[1]));
    return said[3];
  }
  const int from = count() - static_cast<int>(said[0]);
  std::array<std::int64_t, 2> size{mine.exit_code, static_cast<std::int64_t>(mine.reason.size())};
  spread(from, std::as_writable_bytes(std::span(size)));
  std::string reason = mine.reason;
  reason.resize(static_cast<std::size_t>(size[1]));
  spread(from, std::as_writable_bytes(std::span(reason)));
  failed_together_ = true;
  if (from != rank())
    throw OtherRankError(static_cast<int>(size[0]),
                         from == 0 ? reason : "rank " + std::to_string(from) + ": " + reason);
  return said[3];
}

Ranks::Failure Ranks::failure_of(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) != nullptr) return {exit_input, error.what()};
  if (dynamic_cast<const RunError*>(&error) != nullptr) return {exit_run, error.what()};
  return {exit_outside, error.what()};
}

void Ranks::end_work(const Failure& mine) { meet(Meeting::end, 0, mine); }

void Ranks::exchange(std::span<const OutgoingBytes> out, std::span<const IncomingBytes> in) {
  call("exchange", functions_of(*engine_).exchange, out, in);
}

void Ranks::largest(std::span<std::int64_t> numbers) {
  call("largest", functions_of(*engine_).largest, numbers);
}

void Ranks::sum(std::span<std::int64_t> numbers) {
  if (!is_alone()) call("sum", functions_of(*engine_).sum, numbers);
}

void Ranks::spread(int from, std::span<std::byte> bytes) {
  if (!bytes.empty()) call("spread", functions_of(*engine_).spread, from, bytes);
}

}  // namespace hyperlattice
