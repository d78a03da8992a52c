// What writers tell the user: OutputContext::warn.
#pragma once

#include <scene/scene.hpp>

#include <string>
#include <string_view>

namespace hyperlattice {

/// Sentences beyond these are dropped.
inline constexpr std::size_t most_writer_warnings = 20;

/// Returns a writer's sentence in one line, after the name and the place of its stage; cut after
/// 4096 bytes.
std::string writer_warning(const Stage& writer, std::string_view sentence);

}  // namespace hyperlattice
