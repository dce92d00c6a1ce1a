#include "flow_image.hpp"

#include <cstdio>

#include "tunica/stages/imaging/flow_scan_case.hpp"

namespace tunica::app {

void flow_image(const FileRequest& request) {
  auto parsed = stages::read_flow_scan_case(request.file);
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const auto say = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  const auto section = stages::flow_scan_to_files(parsed.value, request.overwrite, say);
  std::printf("written: %s. To measure in it, a file beside it for `tunica measure` has the section\n\n%s",
              parsed.value.output.c_str(), section.c_str());
}

}  // namespace tunica::app
