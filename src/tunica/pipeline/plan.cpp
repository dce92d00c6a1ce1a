#include "tunica/pipeline/plan.hpp"

#include <fmt/format.h>

#include "tunica/base/error.hpp"
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

/// What is to be done after a last time with the same inputs that did not come to its end, or with others.
void compare(const Stage& stage, const fs::path& folder, Plan& p) {
  if (!p.last) {
    p.reason = "never done";
    return;
  }
  const auto change = artifacts::difference(p.last->inputs, p.inputs);
  if (p.last->inputs == p.inputs) {
    p.fresh = p.last->status == "done" && fs::exists(folder / stage.result);
    p.resume = p.last->status != "done";
    if (!p.fresh)
      p.reason = p.resume ? fmt::format("it was {}", p.last->status == "running" ? "interrupted" : p.last->status)
                          : fmt::format("its result {} is missing", stage.result);
    return;
  }
  p.resume = stage.continues(change);
  p.reason = fmt::format("inputs changed: {}{}", artifacts::text_of(change),
                         p.resume ? "; it goes on with what is there" : "");
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
