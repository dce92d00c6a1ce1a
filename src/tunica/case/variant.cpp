#include "tunica/case/variant.hpp"

#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/document.hpp"
#include "tunica/files/series_file.hpp"

namespace tunica::case_file {

std::string variant(const VariantRequest& request) {
  const auto description = Case::schema().description();
  config::Document document(config::read_text(request.case_file), request.case_file.string());
  config::move_paths(document, *description, request.case_file.parent_path(), request.output.parent_path());
  document.set("output.directory", request.output.stem().string());
  for (const auto& key : request.removed) {
    if (!document.has(key))
      throw InputError(key, fmt::format("is no key of {}", request.case_file.string()), "check its spelling");
    document.remove(key);
  }
  for (const auto& setting : request.settings) {
    const auto equals = setting.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw InputError(setting, "is no setting", "write key=value, such as wall.smoothing_length='2 mm'");
    const std::string key = setting.substr(0, equals);
    document.set(key, config::Document(setting.substr(equals + 1), "the value of " + key));
  }
  const std::string text = fmt::format("# A variant of {}.\n", request.case_file.filename().string()) +
                           config::commented_yaml(document, *description);
  parse_case(text, request.output);
  return text;
}

void write_variant(const VariantRequest& request) {
  std::error_code error;
  const bool there = std::filesystem::exists(request.output, error);
  if (error) throw InputError(request.output.string(), error.message(), "give a name that a file can have");
  if (!request.overwrite && there)
    throw InputError(request.output.string(), "is there already", "give another name, or --overwrite");
  const std::string text = variant(request);
  if (const auto folder = request.output.parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, error);
  if (error) throw InputError(request.output.string(), "cannot be written: " + error.message(), "give another place");
  files::write_atomically(request.output, text);
}

}  // namespace tunica::case_file
