// Manual pages in the macros of man(7).
#include "command_tree.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace hyperlattice {
namespace {

/// Returns a text in which no character has a meaning of its own for roff within a line.
std::string plain(const std::string& text) {
  std::string result;
  for (const char letter : text)
    if (letter == '\\')
      result += "\\e";
    else if (letter == '-')
      result += "\\-";
    else
      result += letter;
  return result;
}

/// Returns a text in lines of at most 78 characters, as manual pages have them.
std::string filled(const std::string& text) {
  std::istringstream words(text);
  std::string result, line, word;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > 78) {
      result += line + "\n";
      line.clear();
    }
    // A line that begins with one of these would be a command of roff.
    const bool is_command = line.empty() && (word.front() == '.' || word.front() == '\'');
    line += (is_command ? "\\&" : line.empty() ? "" : " ") + word;
  }
  return result + line;
}

/// Returns a paragraph.
std::string paragraph(const std::string& text) { return filled(plain(text)); }

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return text;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string entry(const OptionFacts& option) {
  std::string text = ".TP\n";
  if (option.is_argument)
    text += italic(option.name) + (option.is_repeated ? "..." : "");
  else
    text += (option.name == "help" ? bold("-h") + ", " : "") + bold("--" + option.name) +
            (option.value.empty() ? "" : " " + italic(option.value));
  text += "\n" + paragraph(option.meaning);
  if (!option.range.empty()) text += "\n(" + plain(option.range) + ")";
  if (!option.needs.empty()) text += "\nNeeds " + bold("--" + option.needs) + ".";
  return text + "\n";
}

std::string section(const std::string& title, const std::vector<OptionFacts>& options) {
  if (options.empty()) return "";
  std::string text = ".SH " + title + "\n";
  for (const OptionFacts& option : options) text += entry(option);
  return text;
}

std::string synopsis(const CommandFacts& command) {
  std::string text =
      ".SH SYNOPSIS\n" + bold("hyperlattice " + command.name) + "\n[" + italic("OPTION") + "]...";
  for (const OptionFacts& argument : arguments_of(command)) {
    const std::string word = italic(argument.name) + (argument.is_repeated ? "..." : "");
    text += argument.is_required ? "\n" + word : "\n[" + word + "]";
  }
  return text + "\n";
}

std::string see_also(const ProgramFacts& facts, const CommandFacts* command) {
  std::string text = ".SH SEE ALSO\n";
  if (command != nullptr) return text + ".BR hyperlattice (1)\n";
  for (std::size_t n = 0; n < facts.commands.size(); ++n)
    text += ".BR hyperlattice\\-" + plain(facts.commands[n].name) + " (1)" +
            (n + 1 < facts.commands.size() ? "," : "") + "\n";
  return text;
}

}  // namespace

std::string manual_page(const ProgramFacts& facts, const CommandFacts* command,
                        const std::string& date) {
  const CommandFacts& subject = command != nullptr ? *command : facts.program;
  const std::string name = page_name(command);
  std::string text = ".TH " + plain(upper(name)) + " 1 " + date + " \"Hyperlattice " +
                     HYPERLATTICE_VERSION + "\" \"User commands\"\n";
  text += ".SH NAME\n" + filled(plain(name) + " \\- " + plain(subject.summary)) + "\n";
  if (command != nullptr) {
    text += synopsis(subject);
    text += section("ARGUMENTS", arguments_of(subject));
  } else {
    text += ".SH SYNOPSIS\n" + bold(name) + "\n[" + italic("OPTION") + "]...\n" +
            italic("COMMAND") + "\n[" + italic("ARGUMENT") + "]...\n.SH COMMANDS\n";
    for (const CommandFacts& one : facts.commands)
      text += ".TP\n" + bold(one.name) + "\n" + paragraph(one.summary) + "\n";
  }
  text += section("OPTIONS", options_of(subject));
  text += ".SH EXIT STATUS\n" + paragraph(facts.footer) + "\n";
  return text + see_also(facts, command);
}

}  // namespace hyperlattice
