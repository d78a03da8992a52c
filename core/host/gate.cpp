#include <host/gate.hpp>

#include <elf.h>

#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

namespace hyperlattice {
namespace {

// Reads the dynamic symbols of an ELF file, which the loader itself uses, and checks every offset.
// Boost.DLL's library_info does not serve: it reads the symbol table that stripping removes, and in
// Boost 1.74 it takes the names from the last string table in the file.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& path) {
    // opening a pipe would wait for its writer
    if (!std::filesystem::is_regular_file(path)) throw Refusal("is not a regular file");
    file_.open(path, std::ios::binary);
    if (!file_) throw Refusal("cannot be read: check its permissions");
    size_ = std::filesystem::file_size(path);
    if (size_ == 0) throw Refusal("is an empty file: build it again");
    char magic[SELFMAG] = {};
    file_.read(magic, SELFMAG);
    if (std::memcmp(magic, ELFMAG, SELFMAG) != 0)
      throw Refusal("is not a shared library (no ELF file)");
  }

  /// Returns the names of the symbols that the library exports.
  std::vector<std::string> exported() {
    const auto header = read<Elf64_Ehdr>(0, 1).front();
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_machine != own_machine)
      throw Refusal("was built for another processor: rebuild it here");
    if (header.e_type != ET_DYN)
      throw Refusal("is not a shared library (an ELF file of another kind)");
    const auto sections = read<Elf64_Shdr>(header.e_shoff, header.e_shnum);
    std::vector<std::string> names;
    for (const Elf64_Shdr& section : sections) {
      if (section.sh_type != SHT_DYNSYM) continue;
      if (section.sh_link >= sections.size()) damaged();
      auto text =
          read<char>(sections[section.sh_link].sh_offset, sections[section.sh_link].sh_size);
      text.push_back('\0');
      for (const Elf64_Sym& symbol :
           read<Elf64_Sym>(section.sh_offset, section.sh_size / sizeof(Elf64_Sym))) {
        if (symbol.st_name >= text.size()) damaged();
        if (symbol.st_shndx != SHN_UNDEF) names.emplace_back(&text[symbol.st_name]);
      }
    }
    return names;
  }

 private:
#if defined(__x86_64__)
  static constexpr Elf64_Half own_machine = EM_X86_64;
#elif defined(__aarch64__)
  static constexpr Elf64_Half own_machine = EM_AARCH64;
#else
#error "say here which ELF machine this processor is"
#endif

  [[noreturn]] static void damaged() { throw Refusal("is damaged or cut short: build it again"); }

  template <class T>
  std::vector<T> read(std::uint64_t offset, std::uint64_t count) {
    if (offset > size_ || count > (size_ - offset) / sizeof(T)) damaged();
    std::vector<T> values(count);
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(values.data()),
               static_cast<std::streamsize>(count * sizeof(T)));
    if (!file_) damaged();
    return values;
  }

  std::ifstream file_;
  std::uint64_t size_ = 0;
};

constexpr std::string_view marker_begin = "_ZN12hyperlattice4GateI", marker_end = "E6markerE";

/// Returns the template arguments `Lj<number>E` in a marker's mangled name; nothing if the symbol
/// is no marker.
std::optional<std::vector<unsigned>> marker_numbers(std::string_view symbol) {
  if (!symbol.starts_with(marker_begin) || !symbol.ends_with(marker_end)) return std::nullopt;
  symbol.remove_prefix(marker_begin.size());
  std::vector<unsigned> numbers;
  while (symbol.starts_with("Lj")) {
    unsigned number = 0;
    const auto [end, error] =
        std::from_chars(symbol.data() + 2, symbol.data() + symbol.size(), number);
    if (error != std::errc()) return std::nullopt;
    numbers.push_back(number);
    symbol.remove_prefix(static_cast<std::size_t>(end - symbol.data()) + 1);
  }
  return numbers;
}

template <unsigned A, unsigned B, unsigned C, unsigned D, unsigned E>
constexpr GateNumbers numbers_of(Gate<A, B, C, D, E>*) {
  return {A, B, C, D, E};
}

std::string differs(const std::string& what, unsigned library, unsigned own,
                    const std::string& remedy) {
  return what + " " + std::to_string(library) + ", this Hyperlattice has " + std::to_string(own) +
         ": " + remedy;
}

}  // namespace

GateNumbers own_gate() { return numbers_of(static_cast<ThisGate<>*>(nullptr)); }

GateNumbers read_gate(const std::filesystem::path& library) {
  for (const std::string& symbol : ElfFile(library).exported()) {
    const auto numbers = marker_numbers(symbol);
    if (!numbers || numbers->empty()) continue;
    const auto& n = *numbers;
    // the gate of another version; this version's has five numbers
    if (n.size() != 5) return {.interface_version = n[0]};
    return {n[0], n[1], n[2], n[3], n[4]};
  }
  throw Refusal(
      "is no plugin of Hyperlattice (it has no gate): build it with hyperlattice_add_plugin and "
      "HYPERLATTICE_PLUGIN");
}

std::string gate_mismatch(const GateNumbers& library, const GateNumbers& own) {
  const std::string headers = "rebuild it against these headers";
  // In another version the other numbers may have other meanings.
  if (library.interface_version != own.interface_version)
    return differs("interface version", library.interface_version, own.interface_version, headers);

  std::string sentence;
  const auto compare = [&](const char* what, unsigned GateNumbers::*number,
                           const std::string& remedy) {
    if (library.*number != own.*number)
      sentence +=
          (sentence.empty() ? "" : "; ") + differs(what, library.*number, own.*number, remedy);
  };
  compare("C++ compiler ABI", &GateNumbers::compiler_abi,
          "rebuild it with a compiler of the same ABI");
  compare("C++ library ABI (_GLIBCXX_USE_CXX11_ABI)", &GateNumbers::library_abi,
          "rebuild it with -D_GLIBCXX_USE_CXX11_ABI=" + std::to_string(own.library_abi));
  compare("Eigen alignment", &GateNumbers::eigen_alignment,
          library.eigen_alignment > own.eigen_alignment
              ? "rebuild it without -march=native (or -mavx, -mavx512f)"
              : "rebuild it for the instruction set that this Hyperlattice was built for");
  if (sentence.empty() && library.boundary != own.boundary)
    return "was built against headers in which what crosses to a plugin is laid out otherwise: " +
           headers;
  return sentence;
}

}  // namespace hyperlattice
