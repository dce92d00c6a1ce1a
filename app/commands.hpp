// The subcommands of tunica, one function and one file each. To add one: write app/<name>.cpp with a function that
// declares its options and gives the subcommand a callback, declare it here and call it in main.cpp. Callbacks throw
// InputError and SolverError, which main turns into exit codes, or CLI::RuntimeError with an exit code of their own.
#pragma once

#include <CLI/CLI.hpp>

namespace tunica::app {

/// For options that name a file or folder: an empty text, such as a variable of the shell that is not set, would mean
/// the folder at hand.
inline CLI::Validator some_name() {
  return {[](const std::string& text) {
            return text.empty() ? "the name is empty: write one, or leave the option out" : "";
          },
          ""};
}

void add_check(CLI::App& app);
void add_compare(CLI::App& app);
void add_completion(CLI::App& app);
void add_converge(CLI::App& app);
void add_export(CLI::App& app);
void add_fibres(CLI::App& app);
void add_fit(CLI::App& app);
void add_follow_up(CLI::App& app);
void add_synthesise(CLI::App& app);
void add_identify(CLI::App& app);
void add_import(CLI::App& app);
void add_manual(CLI::App& app);
void add_material(CLI::App& app);
void add_measure(CLI::App& app);
void add_mesh(CLI::App& app);
void add_motion(CLI::App& app);
void add_picture(CLI::App& app);
void add_plot(CLI::App& app);
void add_post(CLI::App& app);
void add_prestress(CLI::App& app);
void add_report(CLI::App& app);
void add_run(CLI::App& app);
void add_schema(CLI::App& app);
void add_study(CLI::App& app);
void add_tune(CLI::App& app);
void add_validate(CLI::App& app);
void add_vary(CLI::App& app);
void add_verify(CLI::App& app);
void add_view(CLI::App& app);
void add_what_if(CLI::App& app);

}  // namespace tunica::app
