#include "tunica/pipeline/plan.hpp"

#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/case/table_ends.hpp"
#include "tunica/pipeline/foresight.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;

artifacts::Inputs inputs_of(const Chain& chain, const Stage& stage, const config::Document& document) {
  const fs::path folder = folder_of(chain, stage);
  const config::Origin origin{.name = (folder / stage.file).string(), .folder = folder};
  auto inputs = artifacts::inputs_of(stage.settings(document, origin), stage.without);
  artifacts::Fingerprints fingerprints;
  if (stage.reads)
    for (const auto& [name, path] : stage.reads(chain)) fingerprints.add(inputs, name, path);
  return inputs;
}

/// With the same inputs as the last time.
void compare_results(const Stage& stage, const fs::path& folder, Plan& p) {
  if (p.last->status != "done") {
    p.resume = true;
    p.reason = fmt::format("it was {}", p.last->status == "running" ? "interrupted" : p.last->status);
    return;
  }
  const auto lost = lost_outputs(folder, p.last->outputs);
  p.fresh = lost.empty() && fs::exists(folder / stage.result);
  if (p.fresh) return;
  p.resume = !lost.empty() && stage.recovers && stage.recovers(folder, lost);
  p.reason = lost.empty() ? fmt::format("its result {} is missing", stage.result) : text_of_lost(lost);
  if (p.resume) p.reason += "; it goes on with what is there";
}

/// What is to be done after a last time with the same inputs that did not come to its end, or with others.
void compare(const Stage& stage, const fs::path& folder, Plan& p) {
  if (!p.last) {
    p.reason = "never done";
    return;
  }
  const auto change = artifacts::difference(p.last->inputs, p.inputs);
  if (p.last->inputs == p.inputs) {
    compare_results(stage, folder, p);
    return;
  }
  p.resume = stage.continues(change);
  p.reason = fmt::format("inputs changed: {}{}", artifacts::text_of(change),
                         p.resume ? "; it goes on with what is there" : "");
}

/// The files of the stages, which are YAML, name the case file from their folders and these from its own.
void check_paths(const Chain& chain, std::vector<Problem>& problems) {
  const fs::path file = absolute_path(chain.file), folder = file.parent_path(), output = absolute_path(chain.output);
  for (const auto& path : {file.lexically_relative(output), output.lexically_relative(folder)})
    if (text::valid_utf8(path.string()) < path.string().size())
      problems.push_back({text::printable(path.string(), 400),
                          "is a path that is not UTF-8, and the files of the stages have to name it",
                          "rename the file or folder, or choose another folder by --output"});
}

}  // namespace

Chain read_chain(const fs::path& file, const std::optional<fs::path>& directory, std::vector<Problem>& warnings) {
  Chain chain;
  chain.file = file;
  chain.document = case_file::case_document(config::read_text(file), file);
  auto parsed = case_file::read_case(file);
  warnings = std::move(parsed.warnings);
  chain.settings = std::move(parsed.value);
  chain.output = directory.value_or(chain.settings.output.directory);
  std::vector<Problem> problems = foreseen_problems(chain);
  check_paths(chain, problems);
  const auto ends = case_file::check_table_ends(chain.settings.boundary, case_file::asked_by_run(chain.settings));
  problems.insert(problems.end(), ends.begin(), ends.end());
  if (!problems.empty()) throw InputError(std::move(problems));
  return chain;
}

std::vector<const Stage*> wanted_stages(const Chain& chain) {
  std::vector<const Stage*> wanted;
  for (const auto& stage : stages())
    if (stage.wanted(chain.settings)) wanted.push_back(&stage);
  return wanted;
}

Plan plan(const Chain& chain, const Stage& stage, bool anew) {
  const fs::path folder = folder_of(chain, stage);
  Plan p;
  p.document = stage.document(chain, folder);
  p.inputs = inputs_of(chain, stage, p.document);
  p.last = read_record(folder);
  if (p.last && p.last->stage != stage.name)
    throw InputError(folder.string(), fmt::format("holds the stage {}, not {}", p.last->stage, stage.name),
                     "give the stages folders of their own");
  if (anew)
    p.reason = "asked to be done anew";
  else
    compare(stage, folder, p);
  return p;
}

}  // namespace tunica::pipeline
