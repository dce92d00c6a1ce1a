// tunica completion, tunica manual: scripts for shells and the page of the manual, made of the options' definitions.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "option_texts.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// Within single quotes of a shell.
std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

// --- shells -------------------------------------------------------------------------------------------------------

std::string bash(const std::vector<CommandText>& commands) {
  std::string names, cases;
  for (const auto& command : commands) {
    names += command.name + " ";
    cases += fmt::format("    {}) options=\"", command.name);
    for (const auto& option : command.options)
      for (const auto& name : option.names) cases += name + " ";
    cases += "\" ;;\n";
  }
  return fmt::format(
      "# bash completion of tunica\n"
      "_tunica() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} options=\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    COMPREPLY=($(compgen -W \"{}--help --version\" -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  if [[ $word == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
      "  else\n"
      "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _tunica tunica\n",
      names, cases);
}

/// The help of an option between brackets, where _arguments of zsh gives a meaning to them and to colons.
std::string zsh_help(const std::string& help) {
  return replaced(replaced(replaced(help, "[", "\\["), "]", "\\]"), ":", "\\:");
}

std::string zsh(const std::vector<CommandText>& commands) {
  std::string names, cases;
  for (const auto& command : commands) {
    names += fmt::format("    {}\n", quoted(command.name + ":" + replaced(command.help, ":", "\\:")));
    cases += fmt::format("    {}) _arguments", command.name);
    for (const auto& option : command.options)
      for (const auto& name : option.names)
        cases += " \\\n      " + quoted(fmt::format("{}[{}]{}", name, zsh_help(option.help),
                                                    option.value.empty() ? "" : ":value:_files"));
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(
      "#compdef tunica\n"
      "local -a commands\n"
      "commands=(\n{})\n"
      "if ((CURRENT == 2)); then\n"
      "  _describe command commands\n"
      "else\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case $command in\n{}  esac\n"
      "fi\n",
      names, cases);
}

std::string fish(const std::vector<CommandText>& commands) {
  std::string text = "# fish completion of tunica\n";
  for (const auto& command : commands) {
    text +=
        fmt::format("complete -c tunica -f -n __fish_use_subcommand -a {} -d {}\n", command.name, quoted(command.help));
    for (const auto& option : command.options) {
      if (option.names.empty()) continue;
      text += fmt::format("complete -c tunica -n '__fish_seen_subcommand_from {}'", command.name);
      for (const auto& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      text += (option.value.empty() ? " -d " : " -r -d ") + quoted(option.help) + "\n";
    }
  }
  return text;
}

// --- the page of the manual ---------------------------------------------------------------------------------------

std::string roff(std::string text) {
  text = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (text.starts_with(".") || text.starts_with("'")) text.insert(0, "\\&");
  return replaced(replaced(text, "\n.", "\n\\&."), "\n'", "\n\\&'");
}

std::string manual_option(const OptionText& option) {
  std::string head;
  for (const auto& name : option.names) head += (head.empty() ? "" : ", ") + fmt::format("\\fB{}\\fR", roff(name));
  if (!option.value.empty()) head += fmt::format("{}\\fI{}\\fR", head.empty() ? "" : " ", roff(option.value));
  return fmt::format(".TP\n{}\n{}\n", head, roff(option.help));
}

std::string manual(const std::vector<CommandText>& commands) {
  std::string text = fmt::format(
      ".TH TUNICA 1 \"\" \"tunica {}\" \"User commands\"\n"
      ".SH NAME\ntunica \\- fluid\\-structure interaction in aortic dissection\n"
      ".SH SYNOPSIS\n.B tunica\n.I command\n[\\fIargument\\fR ...]\n"
      ".SH DESCRIPTION\n"
      "Computes how blood and the wall of a dissected aorta move each other, from surfaces or an image over meshes,\n"
      "fibre directions, prestress and tuned outlets to a periodic cardiac cycle and a report. Parallel commands are\n"
      "started by \\fBmpirun \\-n\\fR \\fIN\\fR \\fBtunica\\fR ...\n"
      ".SH COMMANDS\n",
      version());
  for (const auto& command : commands) {
    text += fmt::format(".SS tunica {}\n{}.\n", roff(command.name), roff(command.help));
    for (const auto& option : command.options) text += manual_option(option);
    if (!command.footer.empty()) text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.footer));
  }
  return text +
         ".SH \"EXIT STATUS\"\n0 done, 2 the input is wrong, 3 a computation failed, 128 + number of the signal that "
         "stopped it.\n"
         ".SH ENVIRONMENT\n.TP\n.B TUNICA_ISA\nsse2, avx2 or avx512: a narrower instruction set than the processor "
         "has.\n.TP\n.B NO_COLOR\nHas no effect: nothing is printed in colours.\n";
}

}  // namespace

void add_completion(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completion", "Print the completion of commands and options for a shell");
  command->footer(
      "Examples:\n"
      "  tunica completion bash > ~/.local/share/bash-completion/completions/tunica\n"
      "  tunica completion zsh > ~/.zfunc/_tunica            in a folder of fpath\n"
      "  tunica completion fish > ~/.config/fish/completions/tunica.fish");
  using Script = std::string (*)(const std::vector<CommandText>&);
  static constexpr std::pair<const char*, Script> shells[] = {{"bash", bash}, {"fish", fish}, {"zsh", zsh}};
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, fish or zsh")->required()->check(CLI::IsMember({"bash", "fish", "zsh"}));
  command->callback([&app, shell] {
    for (const auto& [name, script] : shells)
      if (*shell == name) std::fputs(script(command_texts(app)).c_str(), stdout);
  });
}

void add_manual(CLI::App& app) {
  CLI::App* command = app.add_subcommand("manual", "Print the page of the manual");
  command->footer("Example:\n  tunica manual > tunica.1; man -l tunica.1");
  command->callback([&app] { std::fputs(manual(command_texts(app)).c_str(), stdout); });
}

}  // namespace tunica::app
