// tunica synthesise: the idealised dissection as a segmented scan; with --flow a computed beat as velocity images, with
// --motion as labels of its phases.
#include <cstdio>
#include <functional>
#include <memory>

#include "beat_images.hpp"
#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
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

/// `before`: what is said first; may be empty.
void describe(CLI::App& command, const std::function<void()>& before) {
  command.footer(
      "Example of a file; `tunica schema --image` prints the reference:\n"
      "  parametric: {flap: {thickness: 1.75 mm}}\n"
      "  scan: {voxel: 0.7 mm, noise: 0.1}\n"
      "  output: dissection.nrrd\n"
      "A scan of a patient is read by `tunica mesh`, from the section `image` of its file.\n"
      "With --flow (`tunica schema --flow-image`):\n"
      "  case: out/dissection/run/case.yaml\n"
      "  period: 0.78 s\n"
      "  scan: {voxel: 2 mm, frames: 25, encoding: 150 cm/s, signal_to_noise: 10}\n"
      "  output: flow_images\n"
      "With --motion (`tunica schema --motion-image`):\n"
      "  case: out/dissection/run/case.yaml\n"
      "  period: 0.78 s\n"
      "  phases: 10\n"
      "  scan: {voxel: 0.7 mm, noise: 0.1}\n"
      "  output: phases");
  const auto flow = std::make_shared<bool>(false);
  const auto motion = std::make_shared<bool>(false);
  auto* option = command.add_flag("--flow", *flow, "Velocity images (phase-contrast MRI) of a beat that was computed");
  command.add_flag("--motion", *motion, "Labels of the phases (gated CT) of a beat that was computed")
      ->excludes(option);
  add_file_arguments(command,
                     {.file = "What is imaged, and how",
                      .output = "The image or the folder of the images, instead of the one that the file names",
                      .overwrite = "Replace images that are there"},
                     [flow, motion, before](const FileRequest& request) {
                       if (before) before();
                       if (*motion) throw CLI::RuntimeError(in_session([&] { return motion_image(request), 0; }));
                       *flow ? flow_image(request) : image(request);
                     });
}

}  // namespace

void add_synthesise(CLI::App& app) {
  describe(*app.add_subcommand("synthesise",
                               "Write a synthetic scan: the idealised dissection as a labelled image with noise, or a "
                               "computed beat as 4D flow or gated CT"),
           {});
  describe(*app.add_subcommand("image", "The name of `tunica synthesise` in earlier versions"), [] {
    std::fprintf(stderr,
                 "tunica: `tunica image` writes a synthetic scan and is called `tunica synthesise` now; a scan of a "
                 "patient is read by `tunica mesh`\n");
  });
}

}  // namespace tunica::app
