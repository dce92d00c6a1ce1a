// Which stage has to be done, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/pipeline/record.hpp"
#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

/// A stage as it would be done now.
struct Plan {
  config::Document document;  ///< its case file
  artifacts::Inputs inputs;
  bool fresh = false;   ///< the result is there and has the same inputs
  bool resume = false;  ///< else: it goes on with what is there
  std::string reason;
  std::optional<Record> last;
};

/// Reads the case file. Throws InputError with all problems that can be found before anything is done. Not collective,
/// as all here.
Chain read_chain(const std::filesystem::path& file, const std::optional<std::filesystem::path>& directory,
                 std::vector<Problem>& warnings);

/// The stages that the case asks for, in order.
std::vector<const Stage*> wanted_stages(const Chain& chain);

/// When the stages before it are done. `anew`: it is asked for in any case.
Plan plan(const Chain& chain, const Stage& stage, bool anew);

}  // namespace tunica::pipeline
