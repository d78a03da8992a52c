// Completion for zsh, with the functions of its own that read a list of options (_arguments).
#include "command_tree.hpp"

namespace hyperlattice {
namespace {

/// Returns a text within single quotes, in which _arguments reads no brackets and colons.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\'')
      result += "'\\''";
    else if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
      result += std::string("\\") + letter;
    else
      result += letter;
  }
  return result;
}

/// Returns the action of _arguments that proposes values.
std::string action(const OptionFacts& option) {
  switch (option.kind) {
    case ValueKind::file:
      return "_files";
    case ValueKind::folder:
      return "_files -/";
    case ValueKind::component:
      return "_hyperlattice_components";
    case ValueKind::lattice:
      return "_hyperlattice_components lattices.";
    case ValueKind::words:
      return "(" + in_one_line(option.words) + ")";
    case ValueKind::none:
      break;
  }
  return " ";
}

std::string specification(const OptionFacts& option) {
  if (option.is_argument)
    return (option.is_repeated ? "'*:" : "':") + escaped(option.name) + ":" + action(option) + "'";
  return std::string("'") + (option.is_repeated ? "*" : "") + "--" + option.name + "[" +
         escaped(option.meaning) + "]" +
         (option.value.empty() ? "" : ":" + escaped(option.value) + ":" + action(option)) + "'";
}

}  // namespace

std::string zsh_completion(const ProgramFacts& facts) {
  std::string everywhere, list, cases;
  for (const OptionFacts& option : facts.program.options)
    everywhere += " \\\n    " + specification(option);
  for (const CommandFacts& command : facts.commands) {
    list += "    '" + command.name + ":" + escaped(command.summary) + "'\n";
    cases += "      " + command.name + ") _arguments";
    for (const OptionFacts& option : command.options)
      cases += " \\\n        " + specification(option);
    cases += " ;;\n";
  }
  return "#compdef hyperlattice\n"
         "# Completion of hyperlattice for zsh, made by `hyperlattice completion zsh`.\n\n"
         "# Proposes the components whose names begin with $1.\n"
         "_hyperlattice_components() {\n"
         "  local -a names\n"
         "  names=(${(M)${(f)\"$(hyperlattice plugins --names 2>/dev/null)\"}:#$1*})\n"
         "  compadd -a names\n"
         "}\n\n"
         "_hyperlattice() {\n"
         "  local curcontext=\"$curcontext\" state line\n"
         "  local -a commands\n"
         "  commands=(\n" +
         list + "  )\n  _arguments -C" + everywhere +
         " \\\n    '1:command:->command' \\\n    '*::argument:->argument'\n"
         "  case $state in\n"
         "    command) _describe command commands ;;\n"
         "    argument) case $words[1] in\n" +
         cases +
         "    esac ;;\n  esac\n}\n\n"
         "if [ \"$funcstack[1]\" = _hyperlattice ]; then _hyperlattice \"$@\"; else compdef "
         "_hyperlattice hyperlattice; fi\n";
}

}  // namespace hyperlattice
