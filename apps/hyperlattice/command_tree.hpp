// The commands and options of the program as plain data, read from their declarations. The manual
// pages and the completion of shells are made from it.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace hyperlattice {

/// What a shell proposes as the value of an option.
enum class ValueKind { none, file, folder, component, lattice, words };

/// An option or an argument of a command.
struct OptionFacts {
  std::string name;          ///< without dashes, such as "out"; of an argument "SCENE"
  std::string value;         ///< name of the value, such as "DIR"; empty: a flag
  std::string meaning;       ///< the sentence of the help
  std::string range;         ///< such as "INT in [1 - 4096]"; empty: any value
  std::string needs;         ///< the option that must be given too, "ranks"; or empty
  bool is_argument = false;  ///< a word of its own, without an option before it
  bool is_required = false, is_repeated = false;
  ValueKind kind = ValueKind::none;
  std::vector<std::string> words;  ///< the values, if the kind is `words`
};

/// A command, such as `run`.
struct CommandFacts {
  std::string name, summary;
  std::vector<OptionFacts> options;  ///< in the order of their declarations
};

/// The program with all its commands.
struct ProgramFacts {
  CommandFacts program;
  std::string footer;
  std::vector<CommandFacts> commands;
};

/// Reads the declarations of the program.
ProgramFacts facts_of(const CLI::App& program);

/// Returns the part of a declaration that is an option with a value or a flag, not an argument.
std::vector<OptionFacts> options_of(const CommandFacts& command);

/// Returns the options of the program that may stand beside any command.
std::vector<OptionFacts> shared_options_of(const ProgramFacts& facts);

/// Returns the arguments of a command, such as SCENE.
std::vector<OptionFacts> arguments_of(const CommandFacts& command);

/// Returns the words with a blank between them.
std::string in_one_line(const std::vector<std::string>& words);

/// Returns the name of a command's manual page, "hyperlattice-run", or of the program's, if null.
std::string page_name(const CommandFacts* command);

/// Returns a manual page in the macros of man(7), of a command or, if null, of the program. `date`:
/// of the page.
std::string manual_page(const ProgramFacts& facts, const CommandFacts* command,
                        const std::string& date);

/// Returns the completion for a shell as a script of this shell.
std::string bash_completion(const ProgramFacts& facts);
std::string zsh_completion(const ProgramFacts& facts);
std::string fish_completion(const ProgramFacts& facts);

}  // namespace hyperlattice
