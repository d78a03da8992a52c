// Inputs damaged at random. The damage is the same on every machine.
#pragma once

#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

namespace hyperlattice::test {

/// Number of damaged inputs that a test tries: HYPERLATTICE_MUTATIONS if set, else `usual`.
inline int mutations(int usual) {
  const char* given = std::getenv("HYPERLATTICE_MUTATIONS");
  return given == nullptr ? usual : std::atoi(given);
}

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }

  /// Changes the text one to three times. Each change erases or repeats a part, inserts a byte of
  /// `alphabet`, replaces a byte by one of them, or cuts the text off.
  std::string operator()(std::string text, std::string_view alphabet) {
    for (std::size_t changes = 1 + below(3); changes > 0 && !text.empty(); --changes) {
      const std::size_t at = below(text.size()), length = 1 + below(below(4) == 0 ? 80 : 5);
      switch (below(5)) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(at, text.substr(below(text.size()), length));
          break;
        case 2:
          text.insert(at, 1, alphabet[below(alphabet.size())]);
          break;
        case 3:
          text.resize(below(8) == 0 ? at : text.size());
          break;
        default:
          text[at] = alphabet[below(alphabet.size())];
      }
    }
    return text;
  }

 private:
  std::mt19937 random_;
};

}  // namespace hyperlattice::test
