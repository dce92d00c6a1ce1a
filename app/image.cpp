// tunica image: the idealised dissection as a segmented scan.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "tunica/stages/imaging/scan_case.hpp"

namespace tunica::app {
namespace {

void image(const std::string& file, const std::string& output, bool overwrite) {
  auto parsed = stages::imaging::read_scan_case(file);
  for (const Problem& warning : parsed.warnings) std::printf("warning: %s\n", format(warning).c_str());
  if (!output.empty()) parsed.value.output = output;
  const auto section = stages::imaging::scan_to_file(parsed.value, overwrite);
  std::printf("written: %s. To mesh it, a file beside it for `tunica mesh` begins with\n\n%s",
              parsed.value.output.c_str(), section.c_str());
}

}  // namespace

void add_image(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("image", "Write the idealised dissection as a labelled image, with the noise of a scanner");
  command->footer(
      "Example of a file; `tunica schema --image` prints the reference:\n"
      "  parametric: {flap: {thickness: 1.75 mm}}\n"
      "  scan: {voxel: 0.7 mm, noise: 0.1}\n"
      "  output: dissection.nrrd");
  const auto file = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  const auto overwrite = std::make_shared<bool>(false);
  command->add_option("file", *file, "What is imaged, and how")->required();
  command->add_option("-o,--output", *output, "The image, instead of the one that the file names");
  command->add_flag("--overwrite", *overwrite, "Replace an image that is there");
  command->callback([=] { image(*file, *output, *overwrite); });
}

}  // namespace tunica::app
