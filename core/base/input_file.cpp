#include <base/errors.hpp>
#include <base/input_file.hpp>

#include <spdlog/fmt/fmt.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace hyperlattice {

std::string read_input_file(const std::filesystem::path& file, const std::string& pointer, const std::string& what) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error))
    throw InputError({{pointer, fmt::format("\"{}\"", file.string()), what + "; there is no such file"}});
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad())
    throw OutsideError(fmt::format("{} cannot be read: {}", file.string(), std::generic_category().message(errno)));
  return text;
}

}  // namespace hyperlattice
