// hyperlattice plugins --test: runs the contract tests of components.
#include "commands.hpp"

#include <contract/contract.hpp>
#include <scene/json.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <array>
#include <iostream>

namespace hyperlattice {
namespace {

using contract::Check;
using contract::Verdict;
constexpr std::size_t verdicts = std::size(contract::verdict_names);

std::string_view name_of(Verdict verdict) {
  return contract::verdict_names[static_cast<std::size_t>(verdict)];
}

void print(const std::vector<Check>& checks) {
  std::size_t width = 0;
  for (const std::string_view name : contract::verdict_names) width = std::max(width, name.size());
  for (const Check& check : checks)
    std::cout << fmt::format("  {:<{}}  {}: {}\n", name_of(check.verdict), width, check.name,
                             check.detail);
  std::cout.flush();
}

nlohmann::ordered_json json_of(const Component& component, const std::vector<Check>& checks) {
  nlohmann::ordered_json json{{"type", component.type()}, {"path", component.path.string()}};
  for (const Check& check : checks)
    json["checks"].push_back(
        {{"name", check.name}, {"verdict", name_of(check.verdict)}, {"detail", check.detail}});
  return json;
}

}  // namespace

int test_plugins(Host& host, const std::vector<const Component*>& components,
                 const std::filesystem::path& pictures, bool json) {
  std::array<std::size_t, verdicts> counts{};
  nlohmann::ordered_json document{{"components", nlohmann::ordered_json::array()}};
  for (const Component* component : components) {
    if (!json) std::cout << component->type() << '\n';
    const std::vector<Check> checks =
        contract::check(*component, host, bundled::other_components, pictures);
    for (const Check& check : checks) ++counts[static_cast<std::size_t>(check.verdict)];
    if (json)
      document["components"].push_back(json_of(*component, checks));
    else
      print(checks);
  }
  if (json) {
    for (std::size_t n = 0; n < verdicts; ++n)
      document[std::string(contract::verdict_names[n])] = counts[n];
    std::cout << json_text(document);
  } else {
    std::cout << fmt::format("{} passed, {} failed, {} not applicable\n", counts[0], counts[1],
                             counts[2]);
  }
  return counts[static_cast<std::size_t>(Verdict::failed)] == 0 ? exit_done : exit_run;
}

}  // namespace hyperlattice
