// Completion for bash.
#include "command_tree.hpp"

namespace hyperlattice {
namespace {

std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char letter : text)
    result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return result + "'";
}

/// Returns the command of the script that proposes values of this option or argument.
std::string proposal(const OptionFacts& option) {
  switch (option.kind) {
    case ValueKind::file:
      return "_hyperlattice_paths -f";
    case ValueKind::folder:
      return "_hyperlattice_paths -d";
    case ValueKind::component:
      return "_hyperlattice_words \"$(hyperlattice plugins --names 2>/dev/null)\"";
    case ValueKind::lattice:
      return "_hyperlattice_words \"$(hyperlattice plugins --names 2>/dev/null | grep "
             "'^lattices')\"";
    case ValueKind::words:
      return "_hyperlattice_words " + in_quotes(in_one_line(option.words));
    case ValueKind::none:
      break;
  }
  return ":";
}

std::string names(const std::vector<OptionFacts>& options) {
  std::string text;
  for (const OptionFacts& option : options) text += (text.empty() ? "--" : " --") + option.name;
  return text;
}

/// The functions that know no command.
constexpr const char* helpers =
    R"(# Completion of hyperlattice for bash, made by `hyperlattice completion bash`.

# Proposes those of the words that begin as the present one.
_hyperlattice_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }

# Proposes files (-f) or folders (-d).
_hyperlattice_paths() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "$1" -- "$word")
}

)";

constexpr const char* start = R"(_hyperlattice() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command='' n
  COMPREPLY=()
  # --out=DIR is three words: --out, =, DIR.
  if [ "$word" = = ]; then word=''; elif [ "$before" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((n = 1; n < COMP_CWORD; ++n)); do
)";

}  // namespace

std::string bash_completion(const ProgramFacts& facts) {
  std::string commands, patterns, values, words;
  const std::string everywhere = names(facts.program.options),
                    shared = names(shared_options_of(facts));
  for (const CommandFacts& command : facts.commands) {
    commands += (commands.empty() ? "" : " ") + command.name;
    patterns += (patterns.empty() ? "" : "|") + command.name;
    for (const OptionFacts& option : options_of(command))
      if (!option.value.empty())
        values += "    " + in_quotes(command.name + " --" + option.name) + ") " + proposal(option) +
                  "; return ;;\n";
    const auto arguments = arguments_of(command);
    words += "    " + command.name + ") if [[ $word = -* ]]; then _hyperlattice_words " +
             in_quotes(names(options_of(command)) + " " + shared) + "; else " +
             (arguments.empty() ? ":" : proposal(arguments.front())) + "; fi ;;\n";
  }
  return std::string(helpers) + start + "    case ${COMP_WORDS[n]} in " + patterns +
         ") command=${COMP_WORDS[n]}; break ;; esac\n  done\n  case \"$command $before\" in\n" +
         values + "  esac\n  case $command in\n" + words +
         "    *) if [[ $word = -* ]]; then _hyperlattice_words " + in_quotes(everywhere) +
         "; else _hyperlattice_words " + in_quotes(commands) +
         "; fi ;;\n  esac\n}\ncomplete -F _hyperlattice hyperlattice\n";
}

}  // namespace hyperlattice
