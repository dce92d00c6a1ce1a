// tunica synthesise: the idealised dissection as a segmented scan.
#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "tunica/stages/imaging/scan_case.hpp"

namespace tunica::app {
namespace {

void image(const FileRequest& request) {
  auto parsed = stages::read_scan_case(request.file);
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const auto section = stages::scan_to_file(parsed.value, request.overwrite);
  std::printf("written: %s. To mesh it, a file beside it for `tunica mesh` begins with\n\n%s",
              parsed.value.output.c_str(), section.c_str());
}

void describe(CLI::App& command, const std::function<void(const FileRequest&)>& action) {
  command.footer(
      "Example of a file; `tunica schema --image` prints the reference:\n"
      "  parametric: {flap: {thickness: 1.75 mm}}\n"
      "  scan: {voxel: 0.7 mm, noise: 0.1}\n"
      "  output: dissection.nrrd\n"
      "A scan of a patient is read by `tunica mesh`, from the section `image` of its file.");
  add_file_arguments(command,
                     {.file = "What is imaged, and how",
                      .output = "The image, instead of the one that the file names",
                      .overwrite = "Replace an image that is there"},
                     action);
}

}  // namespace

void add_synthesise(CLI::App& app) {
  describe(*app.add_subcommand("synthesise",
                               "Write a synthetic scan: the idealised dissection as a labelled image with noise"),
           image);
  describe(*app.add_subcommand("image", "The name of `tunica synthesise` in earlier versions"),
           [](const FileRequest& request) {
             std::fprintf(stderr,
                          "tunica: `tunica image` writes a synthetic scan and is called `tunica synthesise` now; a "
                          "scan of a patient is read by `tunica mesh`\n");
             image(request);
           });
}

}  // namespace tunica::app
