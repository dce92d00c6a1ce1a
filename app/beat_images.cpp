#include "beat_images.hpp"

#include <cstdio>

#include "tunica/stages/imaging/flow_scan_case.hpp"
#include "tunica/stages/imaging/motion_scan_case.hpp"

namespace tunica::app {
namespace {

/// `write` makes the images of a parsed file and returns the section of a file of `next` that reads them.
template <class Parsed, class Write>
void make_images(const FileRequest& request, Parsed parsed, const char* next, const char* purpose, const Write& write) {
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const auto section = write(parsed.value, request.overwrite, [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  });
  std::printf("written: %s. %s, a file beside it for `tunica %s` has the section\n\n%s", parsed.value.output.c_str(),
              purpose, next, section.c_str());
}

}  // namespace

void flow_image(const FileRequest& request) {
  make_images(request, stages::read_flow_scan_case(request.file), "measure", "To measure in it",
              stages::flow_scan_to_files);
}

void motion_image(const FileRequest& request) {
  make_images(request, stages::read_motion_scan_case(request.file), "motion", "To find the motion in it",
              stages::motion_scan_to_files);
}

}  // namespace tunica::app
