// A case file made from another one by giving some of its keys other values: what a study of parameters is made of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::case_file {

struct VariantRequest {
  std::filesystem::path case_file;
  std::filesystem::path output;         ///< the new case file
  std::vector<std::string> settings{};  ///< "key.of.the.case=value", value in YAML; paths in it count from the new file
  std::vector<std::string> removed{};   ///< keys that the new case has no more
  bool overwrite = false;               ///< replace `output` when it is there
};

/// The text of the new case. Paths are rewritten for its place. Results go into a folder beside it that bears its name
/// unless `output.directory` is among the settings. Throws InputError when a setting is no assignment, when a removed
/// key is not there, and with all problems of the new case.
std::string variant(const VariantRequest& request);

/// Writes it to `output`, whose folder is made when it is missing. Throws InputError also when the file is there
/// already.
void write_variant(const VariantRequest& request);

}  // namespace tunica::case_file
