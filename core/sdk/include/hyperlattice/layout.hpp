// The layout of a struct as a hash that the compiler computes: size, alignment, and the offset,
// name and type of each member.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace hyperlattice::detail {

/// FNV-1a hash over numbers and names.
class LayoutHash {
 public:
  constexpr void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) byte(number >> shift & 0xff);
  }
  constexpr void add(std::string_view text) {
    for (const char c : text) byte(static_cast<unsigned char>(c));
    byte(0);
  }
  constexpr std::uint32_t folded() const { return static_cast<std::uint32_t>(sum_ ^ sum_ >> 32); }

 private:
  constexpr void byte(std::uint64_t value) { sum_ = (sum_ ^ value) * 0x100000001b3; }
  std::uint64_t sum_ = 0xcbf29ce484222325;
};

/// A struct of the boundary; HYPERLATTICE_LAYOUT specialises it.
template <class Struct>
struct Layout;

template <class Type>
constexpr void add_type(LayoutHash& hash);

template <class Function>
struct Signature {
  static constexpr bool known = false;
};
template <class Result, class... Arguments, bool Noexcept>
struct Signature<Result (*)(Arguments...) noexcept(Noexcept)> {
  static constexpr bool known = true;
  static constexpr void add_to(LayoutHash& hash) {
    hash.add(Noexcept ? "noexcept" : "throws");
    add_type<Result>(hash);
    (add_type<Arguments>(hash), ...);
  }
};

/// Adds a type to the hash. Types of other libraries (std::span, std::string_view, std::array)
/// count by size and alignment.
template <class Type>
constexpr void add_type(LayoutHash& hash) {
  if constexpr (std::is_const_v<Type>) hash.add("const");
  if constexpr (std::is_void_v<Type>) {
    hash.add("void");
  } else if constexpr (std::is_reference_v<Type>) {
    hash.add("reference");
    add_type<std::remove_reference_t<Type>>(hash);
  } else if constexpr (Signature<std::remove_cv_t<Type>>::known) {
    Signature<std::remove_cv_t<Type>>::add_to(hash);
  } else if constexpr (std::is_pointer_v<Type>) {
    hash.add("pointer");
    add_type<std::remove_pointer_t<Type>>(hash);
  } else if constexpr (std::is_array_v<Type>) {
    hash.add(std::uint64_t{std::extent_v<Type>});
    add_type<std::remove_extent_t<Type>>(hash);
  } else if constexpr (requires { Layout<std::remove_cv_t<Type>>::name; }) {
    hash.add(Layout<std::remove_cv_t<Type>>::name);
  } else if constexpr (requires { sizeof(Type); }) {
    hash.add(std::uint64_t{sizeof(Type)});
    hash.add(std::uint64_t{alignof(Type)});
    hash.add(std::is_floating_point_v<Type> ? "floating" : std::is_signed_v<Type> ? "signed" : "");
  }
}

}  // namespace hyperlattice::detail

// Applies a macro to each name of a list, up to 64 names.
#define HYPERLATTICE_EACH(MACRO, ...) HYPERLATTICE_AGAIN3(HYPERLATTICE_ONE(MACRO, __VA_ARGS__))
#define HYPERLATTICE_ONE(MACRO, NAME, ...) \
  MACRO(NAME) __VA_OPT__(HYPERLATTICE_NEXT HYPERLATTICE_PARENTHESES(MACRO, __VA_ARGS__))
#define HYPERLATTICE_NEXT() HYPERLATTICE_ONE
#define HYPERLATTICE_PARENTHESES ()
#define HYPERLATTICE_AGAIN3(...) \
  HYPERLATTICE_AGAIN2(HYPERLATTICE_AGAIN2(HYPERLATTICE_AGAIN2(HYPERLATTICE_AGAIN2(__VA_ARGS__))))
#define HYPERLATTICE_AGAIN2(...) \
  HYPERLATTICE_AGAIN1(HYPERLATTICE_AGAIN1(HYPERLATTICE_AGAIN1(HYPERLATTICE_AGAIN1(__VA_ARGS__))))
#define HYPERLATTICE_AGAIN1(...) \
  HYPERLATTICE_AGAIN0(HYPERLATTICE_AGAIN0(HYPERLATTICE_AGAIN0(HYPERLATTICE_AGAIN0(__VA_ARGS__))))
#define HYPERLATTICE_AGAIN0(...) __VA_ARGS__

#define HYPERLATTICE_ADD_MEMBER(member)            \
  hash.add(#member);                               \
  hash.add(std::uint64_t{offsetof(Self, member)}); \
  add_type<decltype(Self::member)>(hash);

/// The structured binding compiles only if the list names all members of the struct.
#define HYPERLATTICE_LAYOUT(Struct, ...)                          \
  template <>                                                     \
  struct Layout<Struct> {                                         \
    static constexpr std::string_view name = #Struct;             \
    static void names_all([[maybe_unused]] const Struct& value) { \
      [[maybe_unused]] const auto& [__VA_ARGS__] = value;         \
    }                                                             \
    template <class Self = Struct>                                \
    static constexpr void add_to(LayoutHash& hash) {              \
      hash.add(name);                                             \
      hash.add(std::uint64_t{sizeof(Self)});                      \
      hash.add(std::uint64_t{alignof(Self)});                     \
      HYPERLATTICE_EACH(HYPERLATTICE_ADD_MEMBER, __VA_ARGS__)     \
    }                                                             \
  };
