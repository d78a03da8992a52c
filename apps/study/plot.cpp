// The plot of a study: error against run time on logarithmic axes.
#include <base/gnuplot.hpp>
#include <study/report.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace hyperlattice::study {

namespace {

/// Appends points as a named gnuplot data block, and the labels of those that have one.
void append_points(std::string& text, const std::string& name,
                   const std::vector<std::pair<Cost, std::string>>& points, const char* colour) {
  fmt::format_to(std::back_inserter(text), "{} << EOD\n", name);
  for (const auto& [cost, label] : points)
    fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n", cost.seconds, 100 * cost.error);
  text += "EOD\n";
  for (const auto& [cost, label] : points)
    if (!label.empty())
      fmt::format_to(
          std::back_inserter(text),
          "set label {} at {:.6g},{:.6g} offset 0,0.8 font ',10' tc rgb '{}' noenhanced\n",
          gnuplot_text(label), cost.seconds, 100 * cost.error, colour);
}

class Plot {
 public:
  Plot(const Study& study, const std::vector<Row>& rows, const Findings& findings)
      : study_(study), rows_(rows), findings_(findings) {}

  std::string script() {
    draw_families();
    if (curves_.empty()) return "";
    draw_peers();
    draw_front();
    std::string text =
        "set logscale xy\nset key above left Left reverse "
        "vertical maxrows 6 samplen 2 font ',11'\n";
    fmt::format_to(std::back_inserter(text),
                   "set title {} noenhanced\nset xlabel 'run time in s'\nset ylabel 'error in %, "
                   "{}' noenhanced\n",
                   gnuplot_text(study_.title), norm_names[static_cast<std::size_t>(study_.norm)]);
    fmt::format_to(std::back_inserter(text),
                   "set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", least_.seconds / 2,
                   most_.seconds * 2, 100 * least_.error / 2, 100 * most_.error * 2);
    text += data_;
    fmt::format_to(std::back_inserter(text), "plot {}\n", fmt::join(curves_, ", "));
    return text;
  }

 private:
  void draw_families() {
    std::size_t number = 0;
    for (const auto& members : families(study_, rows_)) {
      std::vector<std::pair<Cost, std::string>> points;
      for (const std::size_t r : members)
        if (rows_[r].error && *rows_[r].error > 0 && rows_[r].seconds() > 0)
          points.emplace_back(Cost{*rows_[r].error, rows_[r].seconds()}, label(rows_[r]));
      if (points.empty()) continue;
      draw("$family", number, points, title(rows_[members.front()].choice), 7);
      ++number;
    }
  }

  void draw_peers() {
    std::map<std::string, std::vector<std::pair<Cost, std::string>>> of_label;
    for (const Peer& peer : study_.peers)
      of_label[peer.label].emplace_back(Cost{peer.error, peer.seconds}, "");
    std::size_t number = 0;
    for (auto& [label, points] : of_label) {
      std::sort(points.begin(), points.end(),
                [](const auto& a, const auto& b) { return a.first.seconds < b.first.seconds; });
      draw("$peer", number, points, label, 9);
      ++number;
    }
  }

  void draw(const char* kind, std::size_t number,
            const std::vector<std::pair<Cost, std::string>>& points, const std::string& title,
            int mark) {
    const std::string name = fmt::format("{}{}", kind, number);
    const char* colour = plot_colours[curves_.size() % plot_colours.size()];
    append_points(data_, name, points, colour);
    for (const auto& [cost, label] : points) include(cost);
    curves_.push_back(fmt::format(
        "{} using 1:2 with linespoints lw 2 pt {} ps 0.9 lc rgb '{}' title {} noenhanced", name,
        mark, colour, gnuplot_text(title)));
  }

  /// Widens the range of the axes to include this cost.
  void include(const Cost& cost) {
    least_ = {std::min(least_.error, cost.error), std::min(least_.seconds, cost.seconds)};
    most_ = {std::max(most_.error, cost.error), std::max(most_.seconds, cost.seconds)};
  }

  void draw_front() {
    std::vector<std::pair<Cost, std::string>> front;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (findings_.pareto[r] && *rows_[r].error > 0 && rows_[r].seconds() > 0)
        front.emplace_back(Cost{*rows_[r].error, rows_[r].seconds()}, "");
    std::sort(front.begin(), front.end(),
              [](const auto& a, const auto& b) { return a.first.seconds < b.first.seconds; });
    append_points(data_, "$front", front, "");
    curves_.emplace_back(
        "$front using 1:2 with points pt 6 ps 2.2 lw 1.5 lc rgb '#000000' title 'Pareto front'");
    if (!findings_.target) return;
    include({*findings_.target, most_.seconds});
    curves_.push_back(fmt::format("{:.6g} with lines dt 2 lc rgb '#555555' title 'target {:.3g} %'",
                                  100 * *findings_.target, 100 * *findings_.target));
  }

  /// Returns the setting and, if it is known and not in doubt, the order of convergence.
  std::string title(const Choice& choice) const {
    if (!study_.refinement) return choice_text(study_.axes, choice);
    const std::string setting = choice_text(study_.axes, choice, {*study_.refinement});
    std::string text = setting.empty() ? "this scene" : setting;
    for (const ChoiceOrder& order : findings_.orders)
      if (order.observed.doubt.empty() && same_but({*study_.refinement}, order.choice, choice))
        text += fmt::format(", order {:.2f}", order.observed.order);
    return text;
  }

  /// Returns the value of the refinement; empty without a refinement, since the title of the line
  /// says all.
  std::string label(const Row& row) const {
    return study_.refinement
               ? study_.axes[*study_.refinement].labels[row.choice[*study_.refinement]]
               : "";
  }

  const Study& study_;
  const std::vector<Row>& rows_;
  const Findings& findings_;
  Cost least_{infinity, infinity}, most_;
  std::string data_;
  std::vector<std::string> curves_;
};

}  // namespace

std::string study_script(const Study& study, const std::vector<Row>& rows,
                         const Findings& findings) {
  return Plot(study, rows, findings).script();
}

}  // namespace hyperlattice::study
