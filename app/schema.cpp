// tunica schema: the reference of the case file and of the files of other subcommands.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

#include "commands.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/descriptions.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/stages/imaging/flow_scan_case.hpp"
#include "tunica/stages/imaging/motion_scan_case.hpp"
#include "tunica/stages/imaging/scan_case.hpp"
#include "tunica/stages/measure/measure.hpp"
#include "tunica/stages/motion/motion.hpp"
#include "tunica/stages/report/report.hpp"

namespace tunica::app {

void add_schema(CLI::App& app) {
  CLI::App* command = app.add_subcommand("schema", "Print the reference of the case file");
  command->footer(
      "Examples:\n  tunica schema > case-file.md\n  tunica schema --json > tunica.schema.json\n"
      "An editor that knows YAML completes and checks case files that begin with the line\n"
      "  # yaml-language-server: $schema=tunica.schema.json");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "As JSON Schema instead of Markdown");
  using Description = std::shared_ptr<const config::Description>;
  struct Kind {
    const char* name;
    std::function<Description()> describe;
    std::string command = name;
    bool wanted = false;
  };
  const auto kinds = std::make_shared<std::vector<Kind>>(std::vector<Kind>{
      {"material", [] { return case_file::material_description(); }},
      {"fit", [] { return case_file::fit_description(); }},
      {"mesh", [] { return case_file::mesh_description(); }},
      {"study", [] { return case_file::study_description(); }},
      {"follow-up", [] { return case_file::follow_up_description(); }},
      {"what-if", [] { return case_file::what_if_description(); }},
      {"identify", [] { return case_file::identify_description(); }},
      {"fibres", [] { return Description(case_file::FibresCase::schema().description()); }},
      {"report", [] { return Description(stages::ReportCase::schema().description()); }},
      {"image", [] { return Description(stages::ScanCase::schema().description()); }, "synthesise"},
      {"flow-image", [] { return Description(stages::FlowScanCase::schema().description()); }, "synthesise --flow"},
      {"motion-image", [] { return Description(stages::MotionScanCase::schema().description()); },
       "synthesise --motion"},
      {"measure", [] { return Description(stages::MeasureCase::schema().description()); }},
      {"motion", [] { return Description(stages::MotionCase::schema().description()); }},
  });
  auto* group = command->add_option_group("file", "Whose file is described instead of that of `tunica run`");
  for (Kind& kind : *kinds)
    group->add_flag(fmt::format("--{}", kind.name), kind.wanted, fmt::format("The file of `tunica {}`", kind.command));
  group->require_option(0, 1);
  command->callback([json, kinds] {
    const auto wanted = std::find_if(kinds->begin(), kinds->end(), [](const Kind& k) { return k.wanted; });
    const Description description =
        wanted == kinds->end() ? case_file::Case::schema().description() : wanted->describe();
    std::fputs((*json ? config::json_schema(*description) : config::markdown(*description)).c_str(), stdout);
  });
}

}  // namespace tunica::app
