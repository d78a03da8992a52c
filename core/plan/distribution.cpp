#include <base/figures.hpp>
#include <plan/distribution.hpp>
#include <plan/estimates.hpp>
#include <plan/text_page.hpp>
#include <state/halo.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

std::vector<std::uint64_t> particles_of_blocks(const Layout& layout) {
  std::vector<std::uint64_t> counts(layout.blocks.size());
  layout.for_stretches([&](const Stretch& stretch) { counts[stretch.block] += stretch.count; });
  return counts;
}

/// Returns the time of the messages of a step, s: the ranks agree, then exchange with two others.
double exchange_seconds(const Distribution& found, const Machine& machine) {
  const auto ranks = static_cast<double>(found.shares.size());
  if (ranks == 1) return 0;
  double most = 0;
  for (const RankShare& share : found.shares) most = std::max(most, share.sent_bytes);
  const double rounds = std::ceil(std::log2(ranks));
  constexpr double neighbours = 2;
  return machine.latency * ((found.whole.empty() ? 1 : 2) * rounds + neighbours) +
         most / machine.bandwidth;
}

/// Returns the time of a step of the whole body in one rank, s.
double step_of_all(const Plan& plan) {
  double sweeps = 0;
  for (const PlannedStage& stage : plan.stages)
    sweeps += static_cast<double>(stage.plan.steps) * stage.plan.sweeps_per_step;
  return sweeps > 0 ? plan.expected_seconds * plan.ranks / sweeps : 0;
}

}  // namespace

Distribution distribution_of(const Plan& plan, const Machine& machine) {
  const Model& model = *plan.model;
  const std::unique_ptr<Layout> layout = make_layout(model, plan.blocks);
  const std::vector<int> owners = owners_of(layout->blocks.size(), plan.ranks);
  const std::vector<std::uint64_t> particles = particles_of_blocks(*layout);
  double sites = 0;
  for (const BlockLayout& block : layout->blocks) sites += static_cast<double>(block.sites);
  Distribution found;
  found.whole = whole_after_steps(plan);
  if (plan.ranks > 1) {
    found.whole_in_ranks = whole_in_ranks(plan);
    found.first_whole = first_needs_whole(plan);
  }
  found.shares.resize(static_cast<std::size_t>(plan.ranks));
  for (std::size_t b = 0; b < owners.size(); ++b) {
    RankShare& share = found.shares[static_cast<std::size_t>(owners[b])];
    share.particles += particles[b];
    share.state_bytes +=
        layout->state_bytes() * static_cast<double>(layout->blocks[b].sites) / sites;
  }
  std::uint64_t most = 0;
  double needed = 0;
  for (std::size_t rank = 0; rank < found.shares.size(); ++rank) {
    RankShare& share = found.shares[rank];
    share.memory_bytes =
        rank_bytes(plan, *layout, share.state_bytes / layout->state_bytes(), rank == 0);
    needed = std::max(needed, share.memory_bytes);
    share.sent_bytes =
        found.whole.empty()
            ? static_cast<double>(Halo(model, *layout, owners, static_cast<int>(rank)).bytes_sent())
            : share.state_bytes * (plan.ranks - 1);
    most = std::max(most, share.particles);
  }
  const auto all = static_cast<double>(model.body.particles);
  found.step_seconds = step_of_all(plan) * static_cast<double>(most) / all;
  found.exchange_seconds = exchange_seconds(found, machine);
  const double mean = step_of_all(plan) / plan.ranks,
               whole = found.step_seconds + found.exchange_seconds;
  found.efficiency = whole > 0 ? mean / whole : 1;
  if (machine.memory && *machine.memory < needed) found.short_of = needed - *machine.memory;
  return found;
}

nlohmann::json distribution_json(const Distribution& found) {
  auto shares = nlohmann::json::array();
  for (const RankShare& share : found.shares)
    shares.push_back({{"particles", share.particles},
                      {"state_bytes", share.state_bytes},
                      {"memory_bytes", share.memory_bytes},
                      {"sent_bytes_per_step", share.sent_bytes}});
  nlohmann::json json = {{"ranks", shares},
                         {"whole_state_after_each_step", found.whole},
                         {"step_seconds", found.step_seconds},
                         {"exchange_seconds", found.exchange_seconds},
                         {"efficiency", found.efficiency},
                         {"whole_state_in_each_rank", found.whole_in_ranks},
                         {"whole_state_in_first_rank", found.first_whole}};
  if (found.short_of) json["memory_short_of_bytes"] = *found.short_of;
  return json;
}

namespace {

std::string memory_text(const Distribution& found) {
  double others = 0, state = 0;
  for (const RankShare& share : found.shares) {
    if (&share != &found.shares.front()) others = std::max(others, share.memory_bytes);
    state = std::max(state, share.state_bytes);
  }
  std::string text = bytes_text(found.shares.front().memory_bytes) + " in the first rank";
  if (others > 0) text += fmt::format(", up to {} in the others", bytes_text(others));
  text += fmt::format("; a rank's own part of the state has up to {}", bytes_text(state));
  if (!found.whole_in_ranks.empty())
    text += ". Each one holds the whole state, because " + found.whole_in_ranks;
  else if (!found.first_whole.empty())
    text += ". The first one gets the whole state for outputs, because " + found.first_whole;
  return text;
}

}  // namespace

std::string distribution_text(const Distribution& found) {
  const auto [least, most] =
      std::minmax_element(found.shares.begin(), found.shares.end(),
                          [](const auto& a, const auto& b) { return a.particles < b.particles; });
  double sent = 0;
  for (const RankShare& share : found.shares) sent = std::max(sent, share.sent_bytes);
  Page page;
  page.section("Ranks");
  page.line("ranks", fmt::format("{}, each with {} to {} particles", found.shares.size(),
                                 count_text(least->particles), count_text(most->particles)));
  page.line("memory", memory_text(found));
  page.line("exchange",
            fmt::format("up to {} from a rank after each step{}", bytes_text(sent),
                        found.whole.empty() ? "" : ": the whole state, because " + found.whole));
  page.line("efficiency",
            fmt::format("{:.1f} % by a model: {:.3g} s to compute a step, {:.3g} s "
                        "to exchange",
                        100 * found.efficiency, found.step_seconds, found.exchange_seconds));
  if (found.short_of)
    page.line("does not fit", fmt::format("a rank lacks {}", bytes_text(*found.short_of)));
  return page.take();
}

}  // namespace hyperlattice
