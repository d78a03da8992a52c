// hyperlattice completion, hyperlattice manual: what shells and man know about the program, made
// from the declarations of its options.
#include "command_tree.hpp"
#include "commands.hpp"
#include "manual_date.hpp"

#include <base/errors.hpp>

#include <iostream>

namespace hyperlattice {
namespace {

constexpr const char* shells = "bash|zsh|fish";

std::string completion(const CLI::App& program, const std::string& shell) {
  const ProgramFacts facts = facts_of(program);
  if (shell == "bash") return bash_completion(facts);
  if (shell == "zsh") return zsh_completion(facts);
  if (shell == "fish") return fish_completion(facts);
  const std::string near = nearest(shell, {"bash", "zsh", "fish"});
  throw InputError(
      {{"SHELL", shell,
        "bash, zsh or fish" + (near.empty() ? "" : "; did you mean '" + near + "'?")}});
}

std::string manual(const CLI::App& program, const std::string& page) {
  const ProgramFacts facts = facts_of(program);
  if (page.empty() || page == page_name(nullptr)) return manual_page(facts, nullptr, manual_date);
  std::vector<std::string> names;
  for (const CommandFacts& command : facts.commands) {
    names.push_back(page_name(&command));
    if (page == names.back()) return manual_page(facts, &command, manual_date);
  }
  const std::string near = nearest(page, names);
  throw InputError({{"PAGE", page,
                     "a page such as hyperlattice-run" +
                         (near.empty() ? "" : "; did you mean '" + near + "'?")}});
}

}  // namespace

Command completion_command(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "completion", "print a script with which a shell completes the words of this program");
  command->add_option("SHELL", *shell, "the shell that reads the script")
      ->required()
      ->type_name(shells);
  return {command, [&program, shell] {
            std::cout << completion(program, *shell);
            return exit_done;
          }};
}

Command manual_command(CLI::App& program) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("manual", "print the manual page of the program or of a command");
  // CLI11 would take the name of a command as this command, so that pages have names of their own.
  command
      ->add_option("PAGE", *name,
                   "hyperlattice (if left out), or a command's page: hyperlattice-run")
      ->type_name("NAME");
  return {command, [&program, name] {
            std::cout << manual(program, *name);
            return exit_done;
          }};
}

}  // namespace hyperlattice
