#include <base/content_hash.hpp>
#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>

#define XXH_INLINE_ALL  // nothing to link
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <vector>

namespace hyperlattice {

struct ContentHash::State {
  XXH3_state_t* state = XXH3_createState();
  State() {
    if (state == nullptr || XXH3_128bits_reset(state) != XXH_OK) throw std::bad_alloc();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { XXH3_freeState(state); }
};

ContentHash::ContentHash() : state_(std::make_shared<State>()) {}

void ContentHash::add(std::string_view bytes) {
  XXH3_128bits_update(state_->state, bytes.data(), bytes.size());
}

std::string ContentHash::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->state);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string hash_of_text(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.text();
}

std::string hash_of_file(const std::filesystem::path& file) {
  constexpr std::size_t piece = 1 << 20;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                               &std::fclose);
  ContentHash hash;
  std::vector<char> bytes(piece);
  for (std::size_t count = piece; stream && count > 0;) {
    count = std::fread(bytes.data(), 1, bytes.size(), stream.get());
    hash.add({bytes.data(), count});
  }
  if (!stream || std::ferror(stream.get()) != 0)
    throw OutsideError(fmt::format("{} cannot be read: {}", file.string(),
                                   std::generic_category().message(errno)));
  return hash.text();
}

}  // namespace hyperlattice
