#include <scene/origins.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

}  // namespace

void Origins::add(const std::string& pointer, const fs::path& file, const std::string& own) {
  // parts below, which came from other files, are replaced
  for (auto below = parts_.upper_bound(pointer + '/');
       below != parts_.end() && below->first.starts_with(pointer + '/');)
    below = parts_.erase(below);
  parts_[pointer] = {file, own};
}

/// Returns the place of the nearest part above a pointer, with the rest of the pointer.
Origins::Place Origins::find(const std::string& pointer) const {
  for (std::string above = pointer;; above.resize(above.rfind('/'))) {
    if (const auto found = parts_.find(above); found != parts_.end())
      return {found->second.file, found->second.pointer + pointer.substr(above.size())};
    if (above.empty() || above.rfind('/') == std::string::npos) return {file_, pointer};
  }
}

fs::path Origins::folder_of(const std::string& pointer) const {
  return find(pointer).file.parent_path();
}

bool Origins::is_of_main_file(const std::string& pointer) const {
  return find(pointer).file == file_;
}

std::string Origins::place_of(const std::string& pointer) const {
  if (is_one_file() || (!pointer.empty() && pointer.front() != '/')) return pointer;
  const Place place = find(pointer);
  return fmt::format("{}:{}", place.file.lexically_relative(file_.parent_path()).string(),
                     place.pointer);
}

InputError Origins::with_places(const InputError& error) const {
  std::vector<Fault> faults = error.faults();
  for (Fault& fault : faults) fault.pointer = place_of(fault.pointer);
  return InputError(std::move(faults));
}

}  // namespace hyperlattice
