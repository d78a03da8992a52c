// Random numbers of particles and springs that are the same in every run, for any number of threads
// and any order of calls.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstdint>

namespace hyperlattice {

/// Returns a hash in which every bit depends on every bit of the argument: the finalizer of
/// SplitMix64 (Steele, Lea and Flood 2014).
constexpr std::uint64_t mixed_bits(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// Returns the random number of the spring between two particles, a < b, uniform in the open
/// interval (0, 1).
constexpr double chance(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return (static_cast<double>(mixed_bits(mixed_bits(mixed_bits(seed) ^ a) ^ b) >> 12) + 0.5) *
         0x1p-52;
}

}  // namespace hyperlattice
