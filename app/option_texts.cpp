#include "option_texts.hpp"

namespace tunica::app {
namespace {

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  for (const auto& name : option.get_snames()) text.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) text.names.push_back("--" + name);
  text.help = option.get_description();
  text.required = option.get_required();
  if (text.names.empty())
    text.value = option.get_name();
  else if (option.get_items_expected_max() > 0)
    text.value = option.get_type_name().empty() ? "VALUE" : option.get_type_name();
  return text;
}

void add_options(const CLI::App& command, std::vector<OptionText>& texts) {
  for (const CLI::Option* option : command.get_options()) texts.push_back(text_of(*option));
  for (const CLI::App* group : command.get_subcommands({}))
    if (group->get_name().empty()) add_options(*group, texts);
}

}  // namespace

std::vector<CommandText> command_texts(const CLI::App& app) {
  std::vector<CommandText> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    CommandText& text =
        commands.emplace_back(CommandText{command->get_name(), command->get_description(), command->get_footer(), {}});
    add_options(*command, text.options);
  }
  return commands;
}

}  // namespace tunica::app
