// tunica plot: curves of a run's histories.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "tunica/drawing/history_plot.hpp"

namespace tunica::app {

void add_plot(CLI::App& app) {
  CLI::App* command = app.add_subcommand("plot", "Draw columns of a run's history (.csv) as curves (.svg, .png)");
  command->footer(
      "A name chooses all columns whose header contains it. Example:\n"
      "  tunica plot results/faces.csv pressure -o pressure.svg");
  const auto options = std::make_shared<drawing::HistoryPlotOptions>();
  command->add_option("history", options->history, "A history that a run wrote: faces.csv, balance.csv, ...")
      ->required();
  command->add_option("columns", options->columns, "Columns to draw")->required();
  command->add_option("-x", options->x, "Column along the axis")->capture_default_str();
  command->add_option("-o,--output", options->output, "The plot, ending in .svg or .png")
      ->required()
      ->check(some_name());
  command->add_option("--title", options->title, "Text above the plot");
  command->callback([options] {
    for (const auto& name : drawing::plot_history(*options)) std::printf("%s\n", name.c_str());
  });
}

}  // namespace tunica::app
