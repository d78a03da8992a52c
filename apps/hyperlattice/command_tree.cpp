// Reads the declarations of the commands and options.
#include "command_tree.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>

namespace hyperlattice {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char letter : text)
    if (letter == separator)
      parts.emplace_back();
    else
      parts.back() += letter;
  return parts;
}

/// Finds what a shell proposes from the name that an option gives its value.
void read_value(OptionFacts& facts, const std::string& type) {
  const std::size_t colon = type.find(':');  // CLI11 adds ranges behind a colon
  facts.value = type.substr(0, colon);
  if (colon != std::string::npos) facts.range = type.substr(colon + 1);
  if (facts.value == "FILE" || facts.value == "CSV" || facts.value == "PATH")
    facts.kind = ValueKind::file;
  else if (facts.value == "DIR" || facts.value == "FOLDER")
    facts.kind = ValueKind::folder;
  else if (facts.value == "COMPONENT")
    facts.kind = ValueKind::component;
  else if (facts.value == "LATTICE")
    facts.kind = ValueKind::lattice;
  else if (facts.value.find('|') != std::string::npos &&
           facts.value.find('=') == std::string::npos) {
    facts.kind = ValueKind::words;
    facts.words = split(facts.value, '|');
  }
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  facts.is_argument = option.get_positional();
  facts.name = facts.is_argument             ? option.get_name(true)
               : option.get_lnames().empty() ? option.get_snames().front()
                                             : option.get_lnames().front();
  facts.meaning = option.get_description();
  facts.is_required = option.get_required();
  if (option.get_items_expected_max() != 0) read_value(facts, option.get_type_name());
  facts.is_repeated = option.get_expected_max() > 1;
  if (const auto needs = option.get_needs(); !needs.empty())
    facts.needs = (*needs.begin())->get_lnames().front();
  return facts;
}

CommandFacts facts_of_command(const CLI::App& command) {
  CommandFacts facts{command.get_name(), command.get_description(), {}};
  for (const CLI::Option* option : command.get_options())
    facts.options.push_back(facts_of(*option));
  return facts;
}

std::vector<OptionFacts> chosen(const CommandFacts& command, bool arguments) {
  std::vector<OptionFacts> found;
  std::copy_if(command.options.begin(), command.options.end(), std::back_inserter(found),
               [arguments](const OptionFacts& option) { return option.is_argument == arguments; });
  return found;
}

}  // namespace

ProgramFacts facts_of(const CLI::App& program) {
  ProgramFacts facts{facts_of_command(program), program.get_footer(), {}};
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    facts.commands.push_back(facts_of_command(*command));
  std::vector<std::string> pages{page_name(nullptr)};
  for (const CommandFacts& command : facts.commands) pages.push_back(page_name(&command));
  for (CommandFacts& command : facts.commands)
    for (OptionFacts& option : command.options)
      if (option.name == "PAGE") {
        option.kind = ValueKind::words;
        option.words = pages;
      }
  return facts;
}

std::string in_one_line(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

std::string page_name(const CommandFacts* command) {
  return command != nullptr ? "hyperlattice-" + command->name : "hyperlattice";
}

std::vector<OptionFacts> options_of(const CommandFacts& command) { return chosen(command, false); }

std::vector<OptionFacts> shared_options_of(const ProgramFacts& facts) {
  std::vector<OptionFacts> found;
  for (const OptionFacts& option : facts.program.options)
    if (option.name != "help" && option.name != "version") found.push_back(option);
  return found;
}

std::vector<OptionFacts> arguments_of(const CommandFacts& command) { return chosen(command, true); }

}  // namespace hyperlattice
