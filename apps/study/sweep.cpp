#include <base/gnuplot.hpp>
#include <study/sweep.hpp>
#include <study/text_table.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace hyperlattice::study {

namespace {

/// Returns the first axis whose values are numbers, at least two of them different; nothing if
/// there is none.
std::optional<std::size_t> numeric_axis(const Study& study, const std::vector<Row>& rows) {
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    std::set<double> numbers;
    const bool all = std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
      if (row.numbers[a]) numbers.insert(*row.numbers[a]);
      return row.numbers[a].has_value();
    });
    if (all && numbers.size() > 1) return a;
  }
  return std::nullopt;
}

/// Places and values of one line of a plot, ascending.
using Points = std::map<double, double>;

/// Returns the lines of the plot of one output, by their titles in the order of the grid.
std::vector<std::pair<std::string, Points>> lines_of(const Study& study,
                                                     const std::vector<Row>& rows, std::size_t axis,
                                                     std::size_t output) {
  std::vector<std::pair<std::string, Points>> lines;
  for (const Row& row : rows) {
    if (row.values.size() <= output) continue;
    const std::string title = choice_text(study.axes, row.choice, {axis});
    auto line = std::find_if(lines.begin(), lines.end(),
                             [&](const auto& known) { return known.first == title; });
    if (line == lines.end()) line = lines.insert(lines.end(), {title, {}});
    line->second[*row.numbers[axis]] = row.values[output];
  }
  return lines;
}

}  // namespace

Json values_json(const Study& study, const Row& row) {
  Json values = Json::object();
  for (std::size_t c = 0; c < row.values.size(); ++c)
    values[study.comparisons[c].name] = row.values[c];
  return values;
}

std::string sweep_table(const Study& study, const std::vector<Row>& rows) {
  Lines lines(1);
  for (const Axis& axis : study.axes) lines[0].push_back(shown_whole(axis.name));
  for (const Comparison& output : study.comparisons) lines[0].push_back(shown_whole(output.name));
  for (const char* name : {"particles", "seconds"}) lines[0].emplace_back(name);
  for (const Row& row : rows) {
    auto& line = lines.emplace_back();
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      line.push_back(shown_whole(study.axes[a].labels[row.choice[a]]));
    for (std::size_t c = 0; c < study.comparisons.size(); ++c)
      line.push_back(c < row.values.size() ? fmt::format("{:.6g}", row.values[c]) : row.status);
    line.push_back(row.is_done() ? fmt::format("{}", row.particles) : "");
    line.push_back(row.is_done() ? fmt::format("{:.3g}", row.seconds()) : "");
  }
  return aligned(lines, study.axes.size());
}

std::string sweep_csv(const Study& study, const std::vector<Row>& rows) {
  std::string text;
  for (const Axis& axis : study.axes) text += axis.name + ',';
  for (const Comparison& output : study.comparisons) text += output.name + ',';
  text += "particles,steps,seconds,setup_seconds,status\n";
  for (const Row& row : rows) {
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      text += study.axes[a].labels[row.choice[a]] + ',';
    for (std::size_t c = 0; c < study.comparisons.size(); ++c)
      text += c < row.values.size() ? fmt::format("{},", row.values[c]) : ",";
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", row.particles, row.steps,
                   row.seconds(), row.setup_seconds, row.status);
  }
  return text;
}

std::string sweep_script(const Study& study, const std::vector<Row>& rows) {
  const auto axis = numeric_axis(study, rows);
  if (!axis) return "";
  std::string data, plots;
  for (std::size_t output = 0; output < study.comparisons.size(); ++output) {
    std::vector<std::string> curves;
    for (const auto& [title, points] : lines_of(study, rows, *axis, output)) {
      const std::string name = fmt::format("$line{}_{}", output, curves.size());
      data += name + " << EOD\n";
      for (const auto& [place, value] : points)
        fmt::format_to(std::back_inserter(data), "{:.9g} {:.9g}\n", place, value);
      data += "EOD\n";
      curves.push_back(fmt::format(
          "{} using 1:2 with linespoints lw 2 pt 7 ps 0.9 lc rgb '{}' title {} noenhanced", name,
          plot_colours[curves.size() % plot_colours.size()], gnuplot_text(title)));
    }
    if (curves.empty()) continue;
    fmt::format_to(std::back_inserter(plots), "set ylabel {} noenhanced\nplot {}\n",
                   gnuplot_text(study.comparisons[output].name), fmt::join(curves, ", "));
  }
  if (plots.empty()) return "";
  return data +
         fmt::format(
             "set key above left Left reverse vertical maxrows 6 samplen 2 font ',11'\n"
             "set xlabel {} noenhanced\nset multiplot layout {},1 title {} noenhanced\n",
             gnuplot_text(study.axes[*axis].name + " (SI)"), study.comparisons.size(),
             gnuplot_text(study.title)) +
         plots + "unset multiplot\n";
}

int sweep_height(const Study& study) {
  return 80 + 340 * static_cast<int>(study.comparisons.size());
}

}  // namespace hyperlattice::study
