// From the file of a what-if to the cases of its variants.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/changed_anatomy.hpp"
#include "tunica/case/what_if_case.hpp"
#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

struct WhatIfPlan {
  case_file::WhatIfCase settings;
  config::Document document;  ///< the file itself
  std::filesystem::path file, case_file, output;

  std::filesystem::path folder_of(std::size_t variant) const { return output / settings.variants[variant].first; }
};

/// `output`: instead of the folder that the file names. Writes nothing. Throws InputError with all that is wrong in the
/// file, the case, and the cases of all variants as far as their keys and values tell. Not collective, as all here.
WhatIfPlan plan_what_if(const std::filesystem::path& file, const std::optional<std::filesystem::path>& output);

/// What a variant makes of the vessel.
analysis::AnatomyChange change_of(const case_file::WhatIf& variant, const Chain& chain);

/// The case file of a variant in its folder, when the stages of the case are done: on its mesh, directions, outlets
/// and, where nothing says otherwise, prestress; a variant that changes the mesh is on `mesh`/meshes.yaml in its
/// folder, has only the outlets in common, and its aorta ends at `end`, as that of the case does.
std::string variant_text(const WhatIfPlan& plan, std::size_t variant, const Chain& chain, const std::string& end);

}  // namespace tunica::pipeline
