#include <base/visible.hpp>
#include <host/plugin_call.hpp>
#include <process/lack_of_memory.hpp>

#include <spdlog/fmt/fmt.h>

#include <new>

namespace hyperlattice {
namespace {

// Signal handlers read this variable, so its memory must exist from the thread's beginning.
[[gnu::tls_model("initial-exec")]] constinit thread_local PluginCall* current = nullptr;

constexpr std::size_t longest_sentence = 4096;

}  // namespace

OutsideError plugin_failure(std::string_view name, std::string_view place, std::string_view library,
                            std::string_view function, std::string_view sentence) {
  return OutsideError(fmt::format("{} ({}{}{}) failed in {}(): {}", name, place,
                                  place.empty() ? "" : ", ", library, function,
                                  visible_line(sentence, longest_sentence)));
}

PluginCall::PluginCall(std::string_view name, const char* library, const char* function,
                       std::string_view place) noexcept
    : name_(name),
      place_(place),
      library_(library),
      function_(function),
      before_(current),
      why_{this, [](void* self, std::string_view sentence) noexcept {
             auto& call = *static_cast<PluginCall*>(self);
             try {
               call.sentence_.assign(sentence.substr(0, longest_sentence));
             } catch (...) {
               call.keep(std::current_exception());
             }
           }} {
  current = this;
}

PluginCall::~PluginCall() { current = before_; }

const std::string* PluginCall::failure(bool done) {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  if (done) return nullptr;
  if (sentence_ == out_of_memory && name_.empty()) throw std::bad_alloc();
  if (sentence_ == out_of_memory)
    throw plugin_failure(name_, place_, library_, function_, lack_of_memory());
  sentence_ = visible_line(sentence_, longest_sentence);
  if (sentence_.empty()) sentence_ = "it does not say why";
  return &sentence_;
}

const PluginCall* PluginCall::running() noexcept { return current; }

PluginCall::HostCode::HostCode() noexcept : caller(std::exchange(current, nullptr)) {}
PluginCall::HostCode::~HostCode() { current = caller; }

}  // namespace hyperlattice
