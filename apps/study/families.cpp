#include <study/families.hpp>

#include <algorithm>

namespace hyperlattice::study {

bool same_but(const std::vector<std::size_t>& axes, Choice a, const Choice& b) {
  for (const std::size_t axis : axes) a[axis] = b[axis];
  return a == b;
}

bool same_case(const Study& study, const Choice& a, const Choice& b) {
  return std::all_of(study.cases.begin(), study.cases.end(),
                     [&](std::size_t axis) { return a[axis] == b[axis]; });
}

std::vector<std::vector<std::size_t>> families(const Study& study, const std::vector<Row>& rows) {
  std::vector<std::vector<std::size_t>> found;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto family = std::find_if(found.begin(), found.end(), [&](const auto& members) {
      return study.refinement &&
             same_but({*study.refinement}, rows[members.front()].choice, rows[r].choice);
    });
    if (family == found.end())
      found.push_back({r});
    else
      family->push_back(r);
  }
  if (study.refinement)
    for (auto& members : found)
      std::stable_sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
        return rows[a].numbers[*study.refinement] > rows[b].numbers[*study.refinement];
      });
  return found;
}

}  // namespace hyperlattice::study
