// Memory of which little is used: the system must not give it in large pages.
#pragma once

#include <cstddef>
#include <span>

namespace hyperlattice {

/// Asks the system for small pages in this memory, before its first use. A write then takes 4 KiB
/// and not the 2 MiB that allocate_array() asks for. Only a hint.
void use_small_pages(std::span<std::byte> memory);

}  // namespace hyperlattice
