#include <base/errors.hpp>
#include <base/visible.hpp>

#include <algorithm>
#include <utility>

namespace hyperlattice {

namespace {

// bytes; one name in an input may have up to 4 GB
constexpr std::size_t longest_place = 200, longest_value = 300, longest_expectation = 2000;
constexpr std::size_t most_lines = 100, most_kept = 1000;  // faults or warnings

std::string lines(const std::vector<Fault>& faults) {
  std::string text;
  for (std::size_t n = 0; n < std::min(faults.size(), most_lines); ++n) {
    const Fault& fault = faults[n];
    if (!text.empty()) text += '\n';
    text += fault.pointer.empty() ? "scene" : visible(fault.pointer, longest_place);
    if (!fault.value.empty()) text += ": " + visible(fault.value, longest_value);
    text += ": expected " + visible(fault.expected, longest_expectation);
  }
  if (faults.size() > most_lines)
    text += "\n... and " + std::to_string(faults.size() - most_lines) + " faults more";
  return text;
}

/// Returns the number of edits (insert, delete, replace, swap of neighbours) that turn a into b:
/// restricted Damerau-Levenshtein distance.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(lines(faults)), faults_(std::move(faults)) {}

void Faults::add(std::string pointer, std::string value, std::string expected) {
  if (faults_.size() < most_kept)
    faults_.push_back({std::move(pointer), std::move(value), std::move(expected)});
  else
    faults_.emplace_back();  // counted only
}

void Faults::throw_if_any() const {
  if (!faults_.empty()) throw InputError(faults_);
}

void Faults::warn(std::string_view pointer, const std::string& sentence) {
  if (warnings_.size() < most_lines)
    warnings_.push_back(visible(pointer, longest_place) + ": " + sentence);
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  // The time of a comparison is proportional to the product of both lengths, for each candidate.
  constexpr std::size_t longest = 100, most = 1000;
  if (name.size() > longest || candidates.size() > most) return "";
  std::string best;
  std::size_t fewest = 2 + name.size() / 3;  // one more than the most edits of a near name
  for (const std::string& candidate : candidates) {
    const std::size_t apart =
        std::max(name.size(), candidate.size()) - std::min(name.size(), candidate.size());
    if (apart >= fewest) continue;
    const std::size_t count = edits(name, candidate);
    if (count < fewest && count < candidate.size()) {  // not if all letters change
      fewest = count;
      best = candidate;
    }
  }
  return best;
}

}  // namespace hyperlattice
