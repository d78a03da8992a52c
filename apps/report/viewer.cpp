#include <report/html.hpp>
#include <report/viewer.hpp>
#include <report/viewer_data.hpp>
#include <report/viewer_scripts.hpp>

#include <spdlog/fmt/fmt.h>

#include <fstream>
#include <iterator>

namespace hyperlattice::report {

namespace {

void replace_all(std::string& text, std::string_view old, std::string_view with) {
  for (std::size_t at = text.find(old); at != std::string::npos;
       at = text.find(old, at + with.size()))
    text.replace(at, old.size(), with);
}

std::string read_three() {
  std::ifstream file(HYPERLATTICE_THREE_JS, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || text.empty())
    throw OutsideError(
        fmt::format("{} cannot be read. --interactive needs three.js: install the package "
                    "libjs-three",
                    HYPERLATTICE_THREE_JS));
  // Neither of these may end the element, of HTML or of XML, early.
  replace_all(text, "]]>", "]] >");
  replace_all(text, "</script", "<\\/script");
  return text;
}

/// Returns a script that is the same for parsers of HTML and of XML.
std::string script(std::string_view text) {
  return fmt::format("<script>//<![CDATA[\n{}\n//]]></script>\n", text);
}

/// Returns JSON as ASCII without characters of markup, which means the same in HTML and in XML.
std::string plain_json(const Json& json) {
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  replace_all(text, "<", "\\u003c");
  replace_all(text, ">", "\\u003e");
  replace_all(text, "&", "\\u0026");
  return text;
}

}  // namespace

std::string viewer_section(const RunRecord& run) {
  const std::string three = read_three();
  const ViewerData data = read_viewer_data(run);
  std::string section = fmt::format(
      "<section class=\"viewer\">\n<style>{}</style>\n<h2>The body in 3D: {}</h2>\n<p "
      "class=\"soft\">Left button: turn. Right button or Shift: move. Wheel: distance. Click: the "
      "values of a particle.</p>\n",
      viewer_style, escaped(run.title()));
  for (const std::string& note : data.notes)
    section += fmt::format("<p class=\"soft\">{}</p>\n", escaped(note));
  section += "<div id=\"viewer-place\"><noscript>This part needs scripts.</noscript></div>\n";
  section += fmt::format(
      "<script type=\"application/json\" id=\"viewer-about\">{}</script>\n<script "
      "type=\"application/octet-stream\" id=\"viewer-numbers\">{}</script>\n",
      plain_json(data.about), base64(data.numbers.bytes()));
  section += script(three) +
             script(fmt::format("(function() {{\n\"use strict\";\n{}}})();", viewer_script));
  section += fmt::format(
      "<details><summary>The licence of three.js, which draws this "
      "part</summary>\n<pre>{}</pre></details>\n</section>\n",
      escaped(three_licence));
  return section;
}

}  // namespace hyperlattice::report
