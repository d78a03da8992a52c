#include <base/errors.hpp>
#include <plan/thread_choice.hpp>
#include <process/processors.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace hyperlattice {

Threads chosen_threads(int number, int node_ranks) {
  if (number > 0) return number;
  const char* wish = std::getenv("OMP_NUM_THREADS");
  if (wish == nullptr || *wish == '\0')
    return Threads::up_to(std::min(processors_of_each(node_ranks), most_threads));
  // OpenMP lists one number for each level of nesting; the first one counts.
  const std::string_view list = wish, first = list.substr(0, list.find(','));
  int found = 0;
  const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), found);
  if (error != std::errc() || end != first.data() + first.size() || found < 1 ||
      found > most_threads)
    throw InputError(
        {{"OMP_NUM_THREADS", std::string(list),
          "in the environment, a number of threads from 1 to " + std::to_string(most_threads)}});
  return found;
}

}  // namespace hyperlattice
