#include "tunica/stages/material/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tunica/artifacts/histories.hpp"
#include "tunica/base/error.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/fitting/deviation.hpp"
#include "tunica/stages/material/commands.hpp"

namespace tunica::stages {

using wall::PathPoint;

namespace {

constexpr const char* tensor_entries[9] = {"11", "12", "13", "21", "22", "23", "31", "32", "33"};
constexpr const char* voigt_entries[6] = {"11", "22", "33", "12", "23", "13"};

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

bool is_shear(const case_file::Loading& loading) { return std::holds_alternative<case_file::SimpleShear>(loading); }
bool is_given(const case_file::Loading& loading) { return std::holds_alternative<case_file::Gradients>(loading); }
bool has_second_stress(const case_file::Loading& loading) {
  return !is_given(loading) && loading.index() != 0 && !is_shear(loading);
}
const char* load_name(const case_file::Loading& loading) {
  return is_given(loading) ? "number" : is_shear(loading) ? "shear" : "stretch";
}
std::string kind(const case_file::Loading& loading) {
  constexpr const char* names[] = {"uniaxial", "equibiaxial", "biaxial", "planar", "simple shear", "given gradients"};
  return names[loading.index()];
}

/// A testing machine: takes a specimen from one point to the next load.
struct Machine {
  wall::FibreFrame axes;
  case_file::LoadPath path;
  std::function<PathPoint(double load, const PathPoint& from)> step;
};

Machine machine(const case_file::Loading& loading, const wall::Law& law, const wall::Volumetric& volumetric) {
  const auto sheet = [&](const case_file::Sheet& s, const std::function<double(double)>& across_at) {
    const wall::FibreFrame axes =
        wall::orthonormal_frame(case_file::vector_of(s.along), case_file::vector_of(s.across), "tests");
    return Machine{axes, s.load, [=, &law](double load, const PathPoint& from) {
                     return wall::stretched(law, volumetric, axes, {load, across_at(load)}, from);
                   }};
  };
  return std::visit(
      Overloaded{
          [&](const case_file::Uniaxial& t) {
            const wall::FibreFrame axes = wall::specimen_axes(case_file::vector_of(t.along));
            return Machine{axes, t.stretch, [=, &law](double load, const PathPoint& from) {
                             return wall::stretched(law, volumetric, axes, {load, std::nullopt}, from);
                           }};
          },
          [&](const case_file::Equibiaxial& t) { return sheet(t, [](double load) { return load; }); },
          [&](const case_file::Biaxial& t) { return sheet(t, [t](double load) { return t.across_at(load); }); },
          [&](const case_file::Planar& t) { return sheet(t, [](double) { return 1.0; }); },
          [&](const case_file::SimpleShear& t) {
            const wall::FibreFrame axes =
                wall::orthonormal_frame(case_file::vector_of(t.along), case_file::vector_of(t.across), "tests");
            return Machine{axes, t.load, [=, &law](double load, const PathPoint&) {
                             return wall::sheared(law, volumetric, axes, load);
                           }};
          },
          [](const case_file::Gradients&) -> Machine { throw std::logic_error("given gradients need no machine"); }},
      loading);
}

std::vector<Mat3<double>> gradients(const case_file::Gradients& given) {
  std::vector<Mat3<double>> all;
  for (const case_file::Gradient& g : given.list) std::copy(g.F.begin(), g.F.end(), &all.emplace_back()(0, 0));
  if (!given.file) return all;
  const files::CsvColumns table =
      files::read_csv(*given.file, "give a header line with F11, F12, ... F33, and lines of numbers");
  for (std::size_t row = 0; row < table.columns.front().size(); ++row) {
    Mat3<double>& F = all.emplace_back();
    for (int n = 0; n < 9; ++n) F(n / 3, n % 3) = table.column(fmt::format("F{}", tensor_entries[n]))[row];
    if (!(determinant(F) > 0.0))
      throw InputError(given.file->string(),
                       fmt::format("line {} of the numbers has det F = {:.4g}", row + 1, determinant(F)),
                       "det F is above zero");
  }
  if (all.empty()) throw InputError(given.file->string(), "has no line of numbers", "give one line for each F");
  return all;
}

MaterialCurve evaluate_gradients(const std::string& name, const case_file::Gradients& given, const wall::Law& law,
                                 const wall::Volumetric& volumetric) {
  MaterialCurve curve{wall::ConstantFrame{}.frame(), {}, {}};
  for (const Mat3<double>& F : gradients(given)) {
    curve.loads.push_back(static_cast<double>(curve.loads.size() + 1));
    if (!std::isfinite(volumetric.bulk_modulus) && std::abs(determinant(F) - 1.0) > 1e-3)
      throw InputError("tests." + name,
                       fmt::format("F number {:.0f} has det F = {:.6g}, but the material is incompressible",
                                   curve.loads.back(), determinant(F)),
                       "give det F = 1 to 1e-3, or a law with a bulk modulus and not `incompressible: true`");
    curve.points.push_back(wall::deformed(law, volumetric, F));
  }
  return curve;
}

}  // namespace

MaterialCurve run_test_at(const std::string& name, const case_file::Loading& loading, const std::vector<double>& loads,
                          const wall::Law& law, const wall::Volumetric& volumetric) {
  const Machine m = machine(loading, law, volumetric);
  MaterialCurve curve{m.axes, loads, {}};
  PathPoint at = wall::deformed(law, volumetric, identity<double>());
  for (const double load : loads) {
    try {
      at = m.step(load, at);
    } catch (const SolverError& error) {
      throw SolverError(fmt::format("test {}, point {}: {}", name, curve.points.size() + 1, error.what()));
    }
    for (const double s : at.state.cauchy.v)
      if (!std::isfinite(s))
        throw SolverError(fmt::format("test {}, point {}: the stress at a {} of {:.6g} is not a finite number", name,
                                      curve.points.size() + 1, load_name(loading), load));
    curve.points.push_back(at);
  }
  return curve;
}

MaterialCurve run_test(const std::string& name, const case_file::Loading& loading, const wall::Law& law,
                       const wall::Volumetric& volumetric) {
  if (const auto* given = std::get_if<case_file::Gradients>(&loading))
    return evaluate_gradients(name, *given, law, volumetric);
  const case_file::LoadPath path = machine(loading, law, volumetric).path;
  std::vector<double> loads;
  for (int step = 0; step <= path.steps; ++step) loads.push_back(path.at(step));
  return run_test_at(name, loading, loads, law, volumetric);
}

std::vector<double> stresses(const MaterialCurve& curve, const case_file::Loading& loading,
                             case_file::StressMeasure measure, bool across) {
  const Vec3<double>& direction = across ? curve.axes.e2 : curve.axes.e1;
  const Vec3<double>& normal = across || is_shear(loading) ? curve.axes.e2 : curve.axes.e1;
  std::vector<double> values;
  for (const PathPoint& p : curve.points) values.push_back(wall::stress_component(p, measure, direction, normal));
  return values;
}

namespace {

/// Runs one test and writes what comes of it.
class TestReport {
 public:
  TestReport(const case_file::MaterialCase& c, const std::string& name, const case_file::MaterialTest& test,
             const wall::Law& law, const std::filesystem::path& folder, std::FILE* screen)
      : case_(c),
        name_(name),
        test_(test),
        law_(law),
        volumetric_(c.volumetric()),
        unit_(c.output.stress),
        per_pascal_(1.0 / config::unit_factor(unit_, config::dimension::pressure)),
        folder_(folder),
        screen_(screen),
        curve_(run_test(name, test.loading, law, volumetric_)) {}

  void write() const {
    write_table();
    print_summary();
    if (is_given(test_.loading)) {
      for (std::size_t n = 0; n < curve_.points.size(); ++n) print_point(n);
      draw({});
    } else {
      draw(compare());
    }
    std::fprintf(screen_, "  %s, %s\n", file(".csv").c_str(), file(case_.output.plot_ending()).c_str());
  }

 private:
  std::string file(const char* extension) const { return (folder_ / (name_ + extension)).string(); }
  std::string with_unit(const std::string& name) const { return fmt::format("{} [{}]", name, unit_); }

  std::vector<double> scaled(std::vector<double> pascals) const {
    for (double& x : pascals) x *= per_pascal_;
    return pascals;
  }
  std::vector<double> drawn(bool across) const {
    return scaled(stresses(curve_, test_.loading, test_.measure, across));
  }
  std::string stress_name(bool across) const {
    const std::string measure = wall::name_of(test_.measure);
    return (is_shear(test_.loading) ? "shear " : "") + measure + (across ? " across" : "");
  }

  void write_table() const {
    std::vector<std::string> columns{load_name(test_.loading)};
    const bool given = is_given(test_.loading), second = has_second_stress(test_.loading);
    for (const char* ij : tensor_entries) columns.push_back(fmt::format("F{}", ij));
    columns.insert(columns.end(), {"J", with_unit("Psi"), with_unit("pressure")});
    for (const char* ij : voigt_entries) columns.push_back(with_unit(fmt::format("S{}", ij)));
    for (const char* ij : voigt_entries) columns.push_back(with_unit(fmt::format("sigma{}", ij)));
    if (!given) columns.push_back(with_unit("P along"));
    if (second) columns.push_back(with_unit("P across"));
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j)
        columns.push_back(with_unit(fmt::format("CC{}{}", voigt_entries[i], voigt_entries[j])));
    artifacts::CsvTable table(file(".csv"), columns, std::nullopt);
    const auto along = stresses(curve_, test_.loading, case_file::StressMeasure::first_piola_kirchhoff, false),
               across = stresses(curve_, test_.loading, case_file::StressMeasure::first_piola_kirchhoff, true);
    for (std::size_t n = 0; n < curve_.points.size(); ++n) {
      const PathPoint& p = curve_.points[n];
      std::vector<double> line{curve_.loads[n]}, pascals{p.energy, p.pressure};
      line.insert(line.end(), &p.F.m[0][0], &p.F.m[0][0] + 9);
      line.push_back(p.state.J);
      pascals.insert(pascals.end(), p.state.stress.v, p.state.stress.v + 6);
      pascals.insert(pascals.end(), p.state.cauchy.v, p.state.cauchy.v + 6);
      if (!given) pascals.push_back(along[n]);
      if (second) pascals.push_back(across[n]);
      pascals.insert(pascals.end(), p.state.tangent.v, p.state.tangent.v + 21);
      for (const double x : pascals) line.push_back(x * per_pascal_);
      table.append(static_cast<std::int64_t>(n), line);
    }
  }

  void print_summary() const {
    std::fprintf(screen_, "%s: %s, %zu points\n", name_.c_str(), kind(test_.loading).c_str(), curve_.points.size());
    if (is_given(test_.loading)) return;
    for (const bool across : {false, true})
      if (!across || has_second_stress(test_.loading))
        std::fprintf(screen_, "  %s at a %s of %.6g: %.6g %s\n", stress_name(across).c_str(), load_name(test_.loading),
                     curve_.loads.back(), drawn(across).back(), unit_.c_str());
  }

  void print_point(std::size_t n) const {
    const PathPoint& p = curve_.points[n];
    std::fprintf(screen_, "  F number %zu: J %.10g, Psi %.10g %s\n", n + 1, p.state.J, p.energy * per_pascal_,
                 unit_.c_str());
    const auto row = [&](const char* label, const double* pascals, int count, int indent) {
      std::fprintf(screen_, "    %-12s%*s", label, 17 * indent, "");
      for (int k = 0; k < count; ++k) std::fprintf(screen_, " %16.9g", pascals[k] * per_pascal_);
      std::fprintf(screen_, "\n");
    };
    std::fprintf(screen_, "    %-12s", unit_.c_str());
    for (const char* ij : voigt_entries) std::fprintf(screen_, " %16s", ij);
    std::fprintf(screen_, "\n");
    row("S", p.state.stress.v, 6, 0);
    row("Cauchy", p.state.cauchy.v, 6, 0);
    const double* entry = p.state.tangent.v;
    for (int i = 0; i < 6; entry += 6 - i, ++i) row(fmt::format("CC {}", voigt_entries[i]).c_str(), entry, 6 - i, i);
  }

  /// The measured points as series, and their deviation on the screen.
  std::vector<drawing::Series> compare() const {
    if (!test_.data) return {};
    const case_file::MeasuredData& data = *test_.data;
    const files::CsvColumns table = files::read_csv(data.file, "give a header line and lines of numbers");
    const std::vector<double>& loads = table.column(data.load);
    if (loads.empty()) throw InputError(data.file.string(), "has no measured point", "give lines of numbers");
    if (!is_shear(test_.loading) && !(*std::min_element(loads.begin(), loads.end()) > 0.05))
      throw InputError(data.file.string(), fmt::format("has stretches below 0.05 under '{}'", data.load),
                       "give stretches, not strains: 1 at rest");
    const MaterialCurve at_data =
        run_test_at(name_ + " at the measured points", test_.loading, loads, law_, volumetric_);
    std::vector<drawing::Series> series;
    for (const bool across : {false, true}) {
      if (across && !data.stress_across) continue;
      std::vector<double> measured = table.column(across ? *data.stress_across : data.stress);
      for (double& x : measured) x *= data.unit;
      const auto d = fitting::deviation(stresses(at_data, test_.loading, test_.measure, across), measured);
      std::fprintf(screen_, "  %s against %zu measured points: RMS deviation %.4g %s%s\n", stress_name(across).c_str(),
                   measured.size(), d.rms * per_pascal_, unit_.c_str(),
                   d.r_squared ? fmt::format(", R^2 {:.5f}", *d.r_squared).c_str() : "");
      series.push_back({.name = across ? "measured across" : "measured",
                        .x = loads,
                        .y = scaled(measured),
                        .line = false,
                        .markers = true,
                        .hollow = true,
                        .colour = across ? 1 : 0});
    }
    return series;
  }

  void draw(std::vector<drawing::Series> more) const {
    drawing::PlotOptions plot;
    plot.title = (case_.title.empty() ? "" : case_.title + ": ") + name_ + " (" + kind(test_.loading) + ")";
    plot.x_label = load_name(test_.loading);
    std::vector<drawing::Series> series;
    if (is_given(test_.loading)) {
      plot.y_label = with_unit("Cauchy stress");
      for (int k = 0; k < 6; ++k) {
        drawing::Series& s =
            series.emplace_back(drawing::Series{.name = voigt_entries[k], .x = curve_.loads, .y = {}, .markers = true});
        for (const PathPoint& p : curve_.points) s.y.push_back(p.state.cauchy[k] * per_pascal_);
      }
    } else {
      const bool second = has_second_stress(test_.loading);
      plot.y_label = with_unit(stress_name(false));
      series.push_back({.name = second ? "along" : "law", .x = curve_.loads, .y = drawn(false)});
      if (second) series.push_back({.name = "across", .x = curve_.loads, .y = drawn(true), .dashed = true});
    }
    series.insert(series.end(), more.begin(), more.end());
    drawing::write_plot(file(case_.output.plot_ending()), series, plot);
  }

  const case_file::MaterialCase& case_;
  const std::string& name_;
  const case_file::MaterialTest& test_;
  const wall::Law& law_;
  wall::Volumetric volumetric_;
  std::string unit_;
  double per_pascal_;
  std::filesystem::path folder_;
  std::FILE* screen_;
  MaterialCurve curve_;
};

}  // namespace

void run_material(const std::filesystem::path& file, const std::optional<std::filesystem::path>& directory,
                  std::FILE* screen) {
  const auto parsed = case_file::read_material_case(file);
  const case_file::MaterialCase& c = parsed.value;
  for (const Problem& warning : parsed.warnings) std::fprintf(screen, "warning: %s\n", format(warning).c_str());
  const wall::Law law = make_law(c.material);
  for (const auto& note : notes(law)) std::fprintf(screen, "%s\n", note.c_str());
  const double K = c.volumetric().bulk_modulus;
  std::fprintf(screen, "%s\n", std::isfinite(K) ? fmt::format("bulk modulus {:.6g} Pa", K).c_str() : "incompressible");
  const std::filesystem::path folder = directory.value_or(c.output.directory);
  const files::FolderLock lock(folder);
  if (!lock.taken_over().empty()) std::fprintf(screen, "warning: %s\n", lock.taken_over().c_str());
  for (const auto& [name, test] : c.tests) TestReport(c, name, test, law, folder, screen).write();
}

}  // namespace tunica::stages
