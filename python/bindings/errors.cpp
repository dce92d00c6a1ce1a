#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "tunica/base/error.hpp"

namespace tunica::python {

namespace py = pybind11;

namespace {

// Exceptions are types of the interpreter, which lives as long as the process does.
PyObject* input_error = nullptr;
PyObject* solver_error = nullptr;

/// Options of the command line are arguments here.
std::string in_python(std::string text) {
  static const std::string option = "--overwrite";
  for (auto at = text.find(option); at != std::string::npos; at = text.find(option, at))
    text.replace(at, option.size(), "overwrite=True");
  return text;
}

py::object exception_of(const InputError& error) {
  std::vector<std::tuple<std::string, std::string, std::string>> problems;
  for (const auto& p : error.problems()) problems.emplace_back(p.where, p.what, in_python(p.remedy));
  py::object value = py::reinterpret_borrow<py::object>(input_error)(in_python(error.what()));
  value.attr("problems") = problems;
  return value;
}

PyObject* new_exception(py::module_& m, const char* name, const char* help, PyObject* base) {
  PyObject* type = PyErr_NewExceptionWithDoc((std::string("tunica.") + name).c_str(), help, base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  m.add_object(name, py::reinterpret_borrow<py::object>(type));
  return type;
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InputError& error) {
    PyErr_SetObject(input_error, exception_of(error).ptr());
  } catch (const SolverError& error) {
    PyErr_SetString(solver_error, in_python(error.what()).c_str());
  }
}

}  // namespace

void use_errors() {
  const py::module_ core = py::module_::import("tunica._core");
  input_error = py::object(core.attr("InputError")).release().ptr();
  solver_error = py::object(core.attr("SolverError")).release().ptr();
  py::register_local_exception_translator(translate);
}

void bind_errors(py::module_& m) {
  input_error = new_exception(m, "InputError",
                              "The input is wrong: a case, a file, a mesh or an argument.\n\n"
                              "`problems` lists all that was found: tuples (where, what, remedy).",
                              PyExc_ValueError);
  solver_error =
      new_exception(m, "SolverError", "The input is fine, but a computation did not succeed.", PyExc_RuntimeError);
  m.def("input_error", [](const std::string& where, const std::string& what, const std::string& remedy) {
    return exception_of(InputError(where, what, remedy));
  });
  py::register_local_exception_translator(translate);
}

}  // namespace tunica::python
