// The layout of the page.
#include <base/figures.hpp>
#include <report/curves.hpp>
#include <report/facts.hpp>
#include <report/html.hpp>
#include <report/report.hpp>
#include <report/style.hpp>
#include <report/verdict.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hyperlattice::report {

namespace {

struct Mark {
  const char* style;
  const char* sign;  ///< readable without colours and on paper
};
constexpr std::array<Mark, 4> marks = {{{"ok", "✓"}, {"warn", "!"}, {"bad", "✗"}, {"note", "·"}}};

template <class... Values>
void put(std::string& page, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(page), format, std::forward<Values>(values)...);
}

void put_plots(std::string& page, const std::vector<Plot>& plots) {
  if (plots.empty()) return;
  page += "<div class=\"columns\">\n";
  for (const Plot& plot : plots)
    put(page, "<figure><figcaption>{}</figcaption>\n{}</figure>\n", escaped(plot.title), svg(plot));
  page += "</div>\n";
}

void put_pictures(std::string& page, const RunRecord& run) {
  for (const PictureSeries& series : run.pictures) {
    put(page, "<h3>Pictures: {}</h3>\n", escaped(series.name));
    if (series.files.size() < series.count)
      put(page, "<p class=\"soft\">{} of {}, evenly chosen.</p>\n", series.files.size(),
          series.count);
    page += "<div class=\"columns pictures\">\n";
    for (const auto& [file, time] : series.files) {
      const std::string name = file.generic_string(),
                        caption = time ? name + " at " + quantity_text(*time, "s") : name;
      const std::string bytes = read_picture(run.folder, file);
      if (bytes.empty())
        put(page, "<p class=\"soft\">{} is too large to be shown.</p>\n", escaped(caption));
      else
        put(page, "<figure><img alt=\"{0}\" src=\"{1}\"/><figcaption>{0}</figcaption></figure>\n",
            escaped(caption), data_uri("image/png", bytes));
    }
    page += "</div>\n";
  }
}

void put_verdict(std::string& page, const RunRecord& run) {
  page += "<ul class=\"verdict\">\n";
  for (const Finding& finding : verdict(run)) {
    const Mark& mark = marks[static_cast<std::size_t>(finding.judgement)];
    put(page, "<li class=\"{}\"><b>{}</b>{}</li>\n", mark.style, mark.sign,
        escaped(finding.sentence));
  }
  page += "</ul>\n";
}

/// Appends the facts of a run as two tables, side by side if the page is wide enough.
void put_facts(std::string& page, const RunRecord& run) {
  std::vector<std::vector<std::string>> rows;
  for (const Fact& fact : facts(run))
    if (!fact.text.empty()) rows.push_back({fact.name, fact.text});
  const auto half = rows.begin() + static_cast<std::ptrdiff_t>((rows.size() + 1) / 2);
  page += "<div class=\"columns\">\n" + table_html({{}, {rows.begin(), half}});
  if (half != rows.end()) page += table_html({{}, {half, rows.end()}});
  page += "</div>\n";
}

HtmlTable plugins_table(const RunRecord& run) {
  HtmlTable table{{"Plugin", "Version", "Path"}, {}};
  const Json plugins =
      run.summary.is_object() ? run.summary.value("plugins", Json::array()) : Json::array();
  for (const Json& plugin : plugins)
    table.rows.push_back(
        {word_in(plugin, "name"), word_in(plugin, "version"), word_in(plugin, "path")});
  return table;
}

void put_run(std::string& page, const RunRecord& run, bool is_only) {
  const bool is_done = run.status() == "done";
  const Mark& mark = is_done ? marks[0] : run.status() == "failed" ? marks[2] : marks[1];
  put(page,
      "<section class=\"run\">\n<{0}>{1}</{0}>\n<p class=\"{2}\"><b>{3} {4}</b></p>\n<p "
      "class=\"soft\">{5}</p>\n",
      is_only ? "h1" : "h2", escaped(is_only ? run.title() : run.label + ": " + run.title()),
      mark.style, mark.sign, escaped(run.status()), escaped(run.folder.string()));
  page += "<h3>Is it stable, and is it right?</h3>\n";
  put_verdict(page, run);
  page += "<h3>What ran</h3>\n";
  put_facts(page, run);
  if (const HtmlTable plugins = plugins_table(run); !plugins.rows.empty())
    page += "<h3>Plugins</h3>\n" + table_html(plugins);
  if (const auto plots = plots_of(run); !plots.empty()) {
    page += "<h3>What happened</h3>\n";
    put_plots(page, plots);
  }
  put_pictures(page, run);
  if (!run.scene.is_null())
    put(page,
        "<details><summary>The scene, with every default filled in, in "
        "SI</summary>\n<pre>{}</pre></details>\n",
        escaped(run.scene.dump(2)));
  page += "</section>\n";
}

/// Returns a table of the facts of all runs, one column for each run.
HtmlTable comparison(const Report& report) {
  HtmlTable table{{""}, {}};
  for (const RunRecord& run : report.runs) {
    table.head.push_back(run.label);
    const auto figures = facts(run);
    table.rows.resize(figures.size());
    for (std::size_t f = 0; f < figures.size(); ++f) {
      if (table.rows[f].empty()) table.rows[f].push_back(figures[f].name);
      table.rows[f].push_back(figures[f].text);
    }
  }
  std::erase_if(table.rows, [](const auto& row) {
    return std::all_of(row.begin() + 1, row.end(), [](const auto& cell) { return cell.empty(); });
  });
  return table;
}

HtmlTable differing(const Report& report) {
  HtmlTable table{{"Place in the scene"}, {}};
  for (const RunRecord& run : report.runs) table.head.push_back(run.label);
  for (const Difference& difference : report.differing) {
    auto& row = table.rows.emplace_back(1, difference.pointer);
    for (const Json& value : difference.values) row.push_back(value.is_null() ? "-" : shown(value));
  }
  return table;
}

void put_together(std::string& page, const Report& report) {
  page += "<section>\n<h2>Side by side</h2>\n" + table_html(comparison(report)) +
          "<h3>In what their scenes differ</h3>\n";
  page += report.differing.empty() ? "<p>In nothing.</p>\n" : table_html(differing(report));
  page += "<h3>Together</h3>\n";
  put_plots(page, plots_together(report.runs));
  page += "</section>\n";
}

void put_study(std::string& page, const StudyRecord& study, bool is_only) {
  put(page, "<section class=\"study\">\n<{0}>{1}</{0}>\n<p class=\"soft\">A study, {2}</p>\n",
      is_only ? "h1" : "h2", escaped(study.title()), escaped(study.folder.string()));
  put(page, "<p>{}</p>\n", escaped(word_in(study.found, "sentence")));
  if (!study.plot.empty())
    put(page, "<figure><img alt=\"error against run time\" src=\"{}\"/></figure>\n",
        data_uri("image/svg+xml", study.plot));
  HtmlTable table{study.table.columns, study.table.rows};
  for (auto& row : table.rows)
    for (std::string& cell : row)
      if (const auto number = csv_number(cell); number && *number != std::round(*number))
        cell = short_number(*number, 4);
  page += table_html(table);
  page += "</section>\n";
}

}  // namespace

std::string report_page(const Report& report, std::string_view last) {
  const std::size_t count = report.runs.size() + report.studies.size();
  const bool is_only = count == 1;
  const std::string title = !is_only
                                ? fmt::format("Report of {} {}", count,
                                              report.studies.empty() ? "runs" : "runs and studies")
                            : report.runs.empty() ? report.studies.front().title()
                                                  : report.runs.front().title();
  std::string page;
  put(page,
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
      "name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n<meta name=\"generator\" content=\"Hyperlattice "
      "{}\"/>\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      HYPERLATTICE_VERSION, escaped(title), style);
  if (!is_only) put(page, "<h1>{}</h1>\n", title);
  if (report.runs.size() > 1) put_together(page, report);
  for (const StudyRecord& study : report.studies) put_study(page, study, is_only);
  for (const RunRecord& run : report.runs) put_run(page, run, is_only);
  page += last;
  page += "</body>\n</html>\n";
  return page;
}

}  // namespace hyperlattice::report
