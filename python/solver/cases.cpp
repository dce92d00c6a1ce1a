#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "solver.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/config/document.hpp"

namespace tunica::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

/// A number or truth value where plain YAML means one, else the text.
py::object scalar(const YAML::Node& node) {
  const std::string text = node.Scalar();
  if (node.Tag() == "!") return py::str(text);  // in quotes
  if (text == "true" || text == "false") return py::bool_(text == "true");
  std::int64_t whole = 0;
  double number = 0;
  if (text.find_first_not_of("+-0123456789") == std::string::npos && YAML::convert<std::int64_t>::decode(node, whole))
    return py::int_(whole);
  if (text.find_first_not_of("+-.eE0123456789") == std::string::npos && YAML::convert<double>::decode(node, number))
    return py::float_(number);
  return py::str(text);
}

py::object to_python(const YAML::Node& node) {
  if (node.IsMap()) {
    py::dict map;
    for (const auto& entry : node) map[py::str(entry.first.Scalar())] = to_python(entry.second);
    return map;
  }
  if (node.IsSequence()) {
    py::list list;
    for (const auto& entry : node) list.append(to_python(entry));
    return list;
  }
  if (node.IsScalar()) return scalar(node);
  return py::none();
}

const config::Description& description() {
  static const auto kept = case_file::Case::schema().description();
  return *kept;
}

/// Every key with its value in SI units, defaults included, and the warnings; all that is wrong is thrown.
py::dict check_case(const std::string& yaml, const fs::path& file) {
  const auto parsed = case_file::read_case(yaml, file);
  std::vector<config::Setting> settings;
  const config::Origin origin{.name = file.string(), .folder = file.parent_path(), .check_files = false};
  config::parse_document(case_file::Case::schema(), case_file::case_document(yaml, file), origin, &settings);
  py::dict values;
  for (const auto& setting : settings) values[py::str(setting.path)] = setting.value;
  py::list warnings;
  for (const auto& warning : parsed.warnings) warnings.append(format(warning));
  py::dict result;
  result["settings"] = values;
  result["warnings"] = warnings;
  return result;
}

std::string case_yaml(const std::string& yaml, const fs::path& file, const fs::path& to) {
  config::Document document(yaml, file.string());
  if (file.parent_path() != to) config::move_paths(document, description(), file.parent_path(), to);
  return config::commented_yaml(document, description());
}

}  // namespace

void bind_cases(py::module_& m) {
  m.def("case_tree", [](const std::string& yaml, const std::string& name) {
    return to_python(config::Document(yaml, name).node());
  });
  m.def("check_case", check_case);
  m.def("case_yaml", case_yaml);
}

}  // namespace tunica::python
