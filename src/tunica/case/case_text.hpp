// Cases and files of `tunica fibres` as text, which need not stand in a file.
#pragma once

#include <filesystem>
#include <string>

#include "tunica/case/case.hpp"
#include "tunica/case/fibres_case.hpp"

namespace tunica::case_file {

/// As read_case() of case.hpp, from the text of a case. `file`: where it stands, or would stand: paths count from its
/// folder.
config::Parsed<Case> read_case(const std::string& yaml, const std::filesystem::path& file);

/// The same of the file of `tunica fibres`.
config::Parsed<FibresCase> read_fibres_case(const std::string& yaml, const std::filesystem::path& file);

}  // namespace tunica::case_file
