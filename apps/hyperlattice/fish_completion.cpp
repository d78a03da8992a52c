// Completion for fish: one line for each option.
#include "command_tree.hpp"

namespace hyperlattice {
namespace {

std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + "'";
}

/// Returns the words of the line that say what is proposed as a value.
std::string proposal(const OptionFacts& option) {
  switch (option.kind) {
    case ValueKind::file:
      return " -F";
    case ValueKind::folder:
      return " -f -a '(__fish_complete_directories)'";
    case ValueKind::component:
      return " -f -a '(hyperlattice plugins --names 2>/dev/null)'";
    case ValueKind::lattice:
      return " -f -a '(hyperlattice plugins --names 2>/dev/null | string match \"lattices.*\")'";
    case ValueKind::words:
      return " -f -a " + in_quotes(in_one_line(option.words));
    case ValueKind::none:
      break;
  }
  return " -f";
}

std::string line(const std::string& condition, const OptionFacts& option) {
  std::string text = "complete -c hyperlattice" + condition;
  if (option.is_argument) return text + proposal(option) + "\n";
  text += " -l " + option.name + " -d " + in_quotes(option.meaning);
  if (!option.value.empty()) text += " -r" + proposal(option);
  return text + "\n";
}

}  // namespace

std::string fish_completion(const ProgramFacts& facts) {
  std::string text =
      "# Completion of hyperlattice for fish, made by `hyperlattice completion fish`.\n"
      "complete -c hyperlattice -f\n";
  for (const OptionFacts& option : facts.program.options) text += line("", option);
  for (const CommandFacts& command : facts.commands)
    text += "complete -c hyperlattice -n __fish_use_subcommand -a " + command.name + " -d " +
            in_quotes(command.summary) + "\n";
  for (const CommandFacts& command : facts.commands)
    for (const OptionFacts& option : command.options)
      text += line(" -n '__fish_seen_subcommand_from " + command.name + "'", option);
  return text;
}

}  // namespace hyperlattice
