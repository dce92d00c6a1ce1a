#include "description.hpp"

#include <pybind11/stl.h>

#include <string>

namespace tunica::python {

namespace py = pybind11;

namespace {

const char* kind_name(config::Kind kind) {
  constexpr const char* names[] = {"quantity", "quantities", "unit",   "integer", "flag",    "choice", "any_of", "text",
                                   "texts",    "file",       "folder", "path",    "section", "map",    "list"};
  return names[static_cast<int>(kind)];
}

bool has_dimension(config::Kind kind) {
  return kind == config::Kind::quantity || kind == config::Kind::quantities || kind == config::Kind::unit;
}

py::dict key_to_dict(const config::Field& field) {
  py::dict d;
  d["key"] = field.key;
  d["kind"] = kind_name(field.kind);
  d["help"] = field.help;
  d["required"] = field.required;
  d["default"] = field.default_text;
  if (has_dimension(field.kind)) {
    d["unit"] = config::si_unit(field.dimension);
    d["units"] = field.dimension == config::dimension::none ? std::string() : config::usual_units(field.dimension);
  }
  d["allowed"] = field.allowed.bounded() ? field.allowed.text(field.dimension) : std::string();
  d["names"] = field.names;
  if (field.nested) d["section"] = python::to_dict(*field.nested);
  return d;
}

void add_keys(const config::Description& description, py::list& keys) {
  for (const auto& include : description.includes) add_keys(*include.nested, keys);
  for (const auto& field : description.fields) keys.append(key_to_dict(field));
}

}  // namespace

py::dict to_dict(const config::Description& description) {
  py::dict d;
  py::list keys;
  add_keys(description, keys);
  d["name"] = description.name;
  d["help"] = description.help;
  d["one_of"] = description.one_of;
  d["keys"] = keys;
  return d;
}

}  // namespace tunica::python
