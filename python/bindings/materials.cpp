#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "description.hpp"
#include "tunica/assembly/isa.hpp"
#include "tunica/wall/material_batch.hpp"
#include "tunica/wall/material_paths.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::python {

namespace py = pybind11;

namespace {

using Array = py::array_t<double, py::array::c_style>;
using Given = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Points between two looks at Ctrl-C.
constexpr std::size_t points_at_once = 65536;

/// A law with its volumetric part, as the section `wall` of a case has them.
struct Specimen {
  wall::LawParameters material;
  wall::VolumetricEnergy volumetric_energy = wall::VolumetricEnergy::simo_taylor;
  std::optional<bool> incompressible;

  static config::Schema<Specimen> schema() {
    return config::Schema<Specimen>("material", "A wall law and its volumetric part.")
        .section("material", &Specimen::material, wall::law_schema(), "Law and its parameters")
        .include(&Specimen::volumetric_energy, wall::volumetric_energy_schema())
        .flag("incompressible", &Specimen::incompressible, "The volume is kept whatever the bulk modulus")
        .check([](const Specimen& s, config::Problems& problems) {
          if (s.incompressible == false && !std::isfinite(wall::bulk_modulus(s.material)))
            problems.add("incompressible", "is false, but the law has no finite bulk modulus",
                         "give the law a bulk_modulus, or a poisson_ratio below 0.5");
        });
  }
};

/// `n` numbers of an array that was given, or made by the caller; null for none.
const double* numbers(const std::optional<Given>& array) { return array ? array->data() : nullptr; }
double* numbers(std::optional<Array>& array) { return array ? array->mutable_data() : nullptr; }

class Material {
 public:
  explicit Material(const std::string& yaml) {
    auto parsed = config::parse_text(Specimen::schema(), yaml, {.name = "material", .folder = "."});
    const Specimen& s = parsed.value;
    for (const Problem& warning : parsed.warnings) warnings_.push_back(format(warning));
    law_ = wall::make_law(s.material);
    volumetric_.energy = s.volumetric_energy;
    if (s.incompressible != true) volumetric_.bulk_modulus = wall::bulk_modulus(s.material);
    directions_ = wall::mean_fibre_directions(s.material);
  }

  bool incompressible() const { return !std::isfinite(volumetric_.bulk_modulus); }
  double bulk_modulus() const { return volumetric_.bulk_modulus; }
  double shear_modulus() const { return wall::shear_modulus_at_rest(law_); }
  std::vector<std::string> notes() const { return wall::notes(law_); }
  const std::vector<std::string>& warnings() const { return warnings_; }
  Array directions() const {
    Array result({static_cast<py::ssize_t>(directions_.size()), py::ssize_t{3}});
    for (std::size_t k = 0; k < directions_.size(); ++k)
      std::copy(directions_[k].x, directions_[k].x + 3, result.mutable_data() + 3 * k);
    return result;
  }

  /// Fills what is given; tunica/materials.py has looked at the shapes.
  void evaluate(const Given& F, const std::optional<Given>& pressure, std::optional<Array> energy,
                std::optional<Array> stress, std::optional<Array> cauchy, std::optional<Array> tangent) const {
    const auto points = static_cast<std::size_t>(F.size()) / 9;
    if (pressure && !incompressible())
      throw InputError("pressure", "is given, but the law has a bulk modulus, which makes it",
                       "leave it out, or make the material `incompressible`");
    std::vector<double> none;
    if (incompressible() && !pressure) none.assign(std::min(points, points_at_once), 0.0);
    const wall::MaterialBatchResults results{numbers(energy), numbers(stress), numbers(cauchy), numbers(tangent)};
    const double *gradients = F.data(), *pressures = numbers(pressure);
    const wall::MaterialBatch batch = wall::material_batch(static_cast<int>(assembly::choose_isa()));
    for (std::size_t first = 0; first < points; first += points_at_once) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const std::size_t count = std::min(points_at_once, points - first);
      const py::gil_scoped_release released;
      check(gradients + 9 * first, first, count);
      const auto from = [&](double* values, std::size_t size) { return values ? values + size * first : nullptr; };
      batch(law_, volumetric_, gradients + 9 * first,
            pressures ? pressures + first : (none.empty() ? nullptr : none.data()), count,
            {from(results.energy, 1), from(results.stress, 9), from(results.cauchy, 9), from(results.tangent, 36)});
    }
  }

  wall::PathPoint stretched(const wall::FibreFrame& axes, double along, std::optional<double> across,
                            const wall::PathPoint& start) const {
    return wall::stretched(law_, volumetric_, axes, {along, across}, start);
  }
  wall::PathPoint sheared(const wall::FibreFrame& axes, double shear) const {
    return wall::sheared(law_, volumetric_, axes, shear);
  }
  wall::PathPoint at_rest() const { return wall::deformed(law_, volumetric_, identity<double>()); }

 private:
  void check(const double* F, std::size_t first, std::size_t count) const {
    for (std::size_t k = 0; k < count; ++k) {
      const double* f = F + 9 * k;
      const double J =
          f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) + f[2] * (f[3] * f[7] - f[4] * f[6]);
      if (!(J > 0.0))
        throw InputError("F", fmt::format("number {} has det F = {:.4g}", first + k, J), "det F is above zero");
      if (incompressible() && std::abs(J - 1.0) > 1e-3)
        throw InputError("F",
                         fmt::format("number {} has det F = {:.6g}, but the material is incompressible", first + k, J),
                         "give det F = 1 to 1e-3, or a law with a bulk modulus and not `incompressible: true`");
    }
  }

  wall::Law law_;
  wall::Volumetric volumetric_;
  std::vector<Vec3<double>> directions_;
  std::vector<std::string> warnings_;
};

Vec3<double> vector_of(const std::array<double, 3>& v) { return {{v[0], v[1], v[2]}}; }

/// The points of a test, as arrays that hold one entry for each.
py::dict curve(const std::vector<wall::PathPoint>& points, const wall::FibreFrame& axes, bool shear) {
  const auto n = static_cast<py::ssize_t>(points.size());
  const auto tensor = [n] { return Array({n, py::ssize_t{3}, py::ssize_t{3}}); };
  Array J(n), energy(n), pressure(n), F = tensor(), S = tensor(), P = tensor(), sigma = tensor(),
                                      along({n, py::ssize_t{3}}), across({n, py::ssize_t{3}}),
                                      tangent({n, py::ssize_t{6}, py::ssize_t{6}});
  const auto put = [](const Mat3<double>& from, Array& to, py::ssize_t k) {
    std::copy(&from.m[0][0], &from.m[0][0] + 9, to.mutable_data() + 9 * k);
  };
  for (py::ssize_t k = 0; k < n; ++k) {
    const wall::PathPoint& p = points[static_cast<std::size_t>(k)];
    J.mutable_at(k) = p.state.J;
    energy.mutable_at(k) = p.energy;
    pressure.mutable_at(k) = p.pressure;
    put(p.F, F, k);
    put(wall::full(p.state.stress), S, k);
    put(wall::full(p.state.cauchy), sigma, k);
    put(p.first_piola_kirchhoff, P, k);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) tangent.mutable_at(k, i, j) = p.state.tangent(i, j);
    for (int m = 0; m < 3; ++m) {
      const auto measure = static_cast<wall::StressMeasure>(m);
      along.mutable_at(k, m) = wall::stress_component(p, measure, axes.e1, shear ? axes.e2 : axes.e1);
      across.mutable_at(k, m) = wall::stress_component(p, measure, axes.e2, axes.e2);
    }
  }
  return py::dict(py::arg("J") = J, py::arg("energy") = energy, py::arg("pressure") = pressure, py::arg("F") = F,
                  py::arg("second_piola_kirchhoff") = S, py::arg("cauchy") = sigma,
                  py::arg("first_piola_kirchhoff") = P, py::arg("tangent") = tangent, py::arg("along") = along,
                  py::arg("across") = across);
}

/// The points of a path, each found by `step` from the one before it.
template <class Step>
std::vector<wall::PathPoint> follow(const Material& material, std::size_t count, const Step& step) {
  std::vector<wall::PathPoint> points;
  wall::PathPoint at = material.at_rest();
  for (std::size_t k = 0; k < count; ++k) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    try {
      at = step(k, at);
    } catch (const SolverError& error) {
      throw SolverError(fmt::format("point {}: {}", k, error.what()));
    }
    points.push_back(at);
  }
  return points;
}

py::dict pull(const Material& material, const std::array<double, 3>& along, const std::vector<double>& stretches) {
  const wall::FibreFrame axes = wall::specimen_axes(vector_of(along));
  const auto points = follow(material, stretches.size(), [&](std::size_t k, const wall::PathPoint& from) {
    return material.stretched(axes, stretches[k], std::nullopt, from);
  });
  return curve(points, axes, false);
}

py::dict pull_both(const Material& material, const std::array<double, 3>& along, const std::array<double, 3>& across,
                   const std::vector<double>& first, const std::vector<double>& second) {
  const wall::FibreFrame axes = wall::orthonormal_frame(vector_of(along), vector_of(across), "biaxial");
  const auto points = follow(material, first.size(), [&](std::size_t k, const wall::PathPoint& from) {
    return material.stretched(axes, first[k], second.at(k), from);
  });
  return curve(points, axes, false);
}

py::dict shear(const Material& material, const std::array<double, 3>& along, const std::array<double, 3>& across,
               const std::vector<double>& amounts) {
  const wall::FibreFrame axes = wall::orthonormal_frame(vector_of(along), vector_of(across), "simple_shear");
  const auto points = follow(material, amounts.size(),
                             [&](std::size_t k, const wall::PathPoint&) { return material.sheared(axes, amounts[k]); });
  return curve(points, axes, true);
}

}  // namespace

void bind_materials(py::module_& m) {
  py::class_<Material>(m, "Law")
      .def(py::init<const std::string&>())
      .def_property_readonly("incompressible", &Material::incompressible)
      .def_property_readonly("bulk_modulus", &Material::bulk_modulus)
      .def_property_readonly("shear_modulus", &Material::shear_modulus)
      .def_property_readonly("fibre_directions", &Material::directions)
      .def_property_readonly("notes", &Material::notes)
      .def_property_readonly("warnings", &Material::warnings)
      .def("evaluate", &Material::evaluate, py::arg("F"), py::arg("pressure"), py::arg("energy").noconvert(),
           py::arg("stress").noconvert(), py::arg("cauchy").noconvert(), py::arg("tangent").noconvert())
      .def("pull", &pull)
      .def("pull_both", &pull_both)
      .def("shear", &shear);
  m.def("describe_laws", [] { return to_dict(*Specimen::schema().description()); });
  m.def("instruction_set", [] { return std::string(assembly::name(assembly::choose_isa())); });
}

}  // namespace tunica::python
