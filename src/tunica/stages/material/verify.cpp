#include "tunica/stages/material/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/artifacts/histories.hpp"
#include "tunica/base/error.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/material/commands.hpp"
#include "tunica/stages/material/material.hpp"

namespace tunica::stages {

namespace {

constexpr double element_bound = 1e-4, direction_bound = 6e-3;
// Without exclusion the 256 directions themselves are 0.62 % off in the smallest shears.
constexpr double open_shear_bound = 6.5e-3;

bool is_extension(const CubeCase& c) { return c.loading == CubeLoading::extension; }
const char* test_name(const CubeCase& c) { return is_extension(c) ? "uniaxial" : "shear"; }

/// Stress of the 256 directions at the material point.
std::vector<double> point_stresses(const CubeCase& c, bool incompressible) {
  const wall::DfdParameters parameters = c.material.parameters();
  const wall::Law law = parameters.law();
  wall::Volumetric volumetric;
  if (!incompressible) volumetric.bulk_modulus = parameters.bulk_modulus();
  const case_file::Direction e1 = case_file::Axis<0>{}, e3 = case_file::Axis<2>{};
  case_file::Loading loading = case_file::Uniaxial{e3, {}};
  if (!is_extension(c)) {
    case_file::SimpleShear shear;
    shear.along = e1;
    shear.across = e3;
    loading = shear;
  }
  return stresses(run_test_at(test_name(c), loading, c.loads(), law, volumetric), loading,
                  case_file::StressMeasure::cauchy, false);
}

/// A stress that is no number is infinitely far off.
double worse(double largest, double difference) {
  return std::isfinite(difference) ? std::max(largest, difference) : std::numeric_limits<double>::infinity();
}

double pointwise(const std::vector<double>& a, const std::vector<double>& reference) {
  double largest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = worse(largest, std::abs(a[n] / reference[n] - 1.0));
  return largest;
}

double to_the_largest(const std::vector<double>& a, const std::vector<double>& reference) {
  double difference = 0.0, size = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    difference = worse(difference, std::abs(a[n] - reference[n]));
    size = std::max(size, std::abs(reference[n]));
  }
  return difference / size;
}

void write_table(const std::filesystem::path& folder, const std::vector<VerifiedCase>& cases) {
  const CubeCase& first = cases.front().definition;
  std::vector<std::string> columns{is_extension(first) ? "stretch" : "shear"};
  for (const VerifiedCase& c : cases)
    for (const char* what :
         {"analytic", "256 directions", "256 directions finite K", "mixed element", "displacement element"})
      columns.push_back(fmt::format("{} {} [kPa]", c.definition.name(), what));
  artifacts::CsvTable table(folder / fmt::format("{}.csv", test_name(first)), columns, std::nullopt);
  for (std::size_t n = 0; n < cases.front().loads.size(); ++n) {
    std::vector<double> line{cases.front().loads[n]};
    for (const VerifiedCase& c : cases)
      for (const auto* values : {&c.analytic, &c.sum, &c.point, &c.mixed.stresses, &c.displacement.stresses})
        line.push_back(1e-3 * (*values)[n]);
    table.append(static_cast<std::int64_t>(n + 1), line);
  }
}

/// Every fourth finite element solution.
drawing::Series symbols(const VerifiedCase& c, const CubeSolution& solution, const char* name, bool hollow,
                        int colour) {
  drawing::Series s{.name = name, .x = {}, .y = {}, .line = false, .markers = true, .hollow = hollow, .colour = colour};
  for (std::size_t n = 3; n < c.loads.size(); n += 4) {
    s.x.push_back(c.loads[n]);
    s.y.push_back(1e-3 * solution.stresses[n]);
  }
  return s;
}

void write_figure(const std::filesystem::path& folder, const std::vector<VerifiedCase>& cases) {
  const bool extension = is_extension(cases.front().definition);
  drawing::PlotOptions plot;
  plot.title = extension ? "Uniaxial extension, 256 directions: lines analytic, symbols finite elements"
                         : "Simple shear, 256 directions: lines analytic, symbols finite elements";
  plot.x_label = extension ? "stretch" : "amount of shear";
  plot.y_label = extension ? "Cauchy stress 33 [kPa]" : "Cauchy stress 13 [kPa]";
  std::vector<drawing::Series> series;
  int colour = 0;
  for (const VerifiedCase& c : cases) {
    drawing::Series line{.name = c.definition.name(), .x = {extension ? 1.0 : 0.0}, .y = {0.0}};
    line.dashed = !c.definition.material.tension_only;
    line.colour = colour;
    for (std::size_t n = 0; n < c.loads.size(); ++n) {
      line.x.push_back(c.loads[n]);
      line.y.push_back(1e-3 * c.analytic[n]);
    }
    series.push_back(line);
    const bool named = &c == &cases.front();
    series.push_back(symbols(c, c.mixed, named ? "mixed element" : "", true, colour));
    series.push_back(symbols(c, c.displacement, named ? "displacement element" : "", false, colour));
    ++colour;
  }
  drawing::write_plot((folder / fmt::format("{}.svg", test_name(cases.front().definition))).string(), series, plot);
}

void print_case(const VerifiedCase& c, std::FILE* screen) {
  std::fprintf(screen, "%s, %s\n", test_name(c.definition), c.definition.name().c_str());
  for (const auto& [name, s] : {std::pair{"mixed", &c.mixed}, std::pair{"displacement", &c.displacement}})
    std::fprintf(screen,
                 "  %-12s element: %d loads, %d Newton and %d linear iterations, stress uniform to %.1e, residual "
                 "reduced to %.1e\n",
                 name, static_cast<int>(c.loads.size()), s->newton_iterations, s->linear_iterations, s->scatter,
                 s->largest_residual);
}

/// The list as text and as CSV.
void report(const std::filesystem::path& folder, const std::vector<Comparison>& comparisons, std::FILE* screen) {
  std::string csv = "test,curve,comparison,largest relative difference,bound,passed\n";
  std::fprintf(screen, "\n%-9s %-26s %-66s %10s %8s\n", "test", "curve", "comparison", "difference", "bound");
  for (const Comparison& c : comparisons) {
    std::fprintf(screen, "%-9s %-26s %-66s %10.2e %8.1e  %s\n", c.test.c_str(), c.curve.c_str(), c.what.c_str(),
                 c.difference, c.bound, c.passed() ? "pass" : "FAIL");
    csv += fmt::format("{},\"{}\",\"{}\",{:.4e},{:.4e},{}\n", c.test, c.curve, c.what, c.difference, c.bound,
                       c.passed() ? "yes" : "no");
  }
  files::write_atomically(folder / "comparisons.csv", csv);
}

}  // namespace

VerifiedCase verify_case(const CubeCase& c) {
  VerifiedCase v{c, c.loads(), {}, point_stresses(c, true), point_stresses(c, false), {}, {}};
  for (const double load : v.loads) v.analytic.push_back(analytic_stress(c, load));
  v.mixed = solve_cube(c, wall::Element::mixed);
  v.displacement = solve_cube(c, wall::Element::displacement);
  return v;
}

std::vector<Comparison> compare(const VerifiedCase& c) {
  const CubeCase& d = c.definition;
  const auto entry = [&](const std::string& what, double difference, double bound) {
    return Comparison{test_name(d), d.name(), what, difference, bound};
  };
  const double pointwise_bound = is_extension(d) || d.material.tension_only ? direction_bound : open_shear_bound;
  return {entry("mixed element - 256 directions, same K, any element",
                pointwise(c.mixed.stresses, c.point) + c.mixed.scatter, element_bound),
          entry("displacement element - 256 directions, same K, any element",
                pointwise(c.displacement.stresses, c.point) + c.displacement.scatter, element_bound),
          entry("mixed element - analytic, of the largest stress", to_the_largest(c.mixed.stresses, c.analytic),
                direction_bound),
          entry("displacement element - analytic, of the largest stress",
                to_the_largest(c.displacement.stresses, c.analytic), direction_bound),
          entry("256 directions - analytic, of the largest stress", to_the_largest(c.sum, c.analytic), direction_bound),
          entry("256 directions - analytic, pointwise", pointwise(c.sum, c.analytic), pointwise_bound)};
}

bool verify(const std::filesystem::path& folder, std::FILE* screen) {
  if (parallel::size(MPI_COMM_WORLD) != 1)
    throw InputError("tunica verify", "runs on one rank: the cube has 19 nodes", "start it without mpirun");
  const files::FolderLock lock(folder);
  if (!lock.taken_over().empty()) std::fprintf(screen, "warning: %s\n", lock.taken_over().c_str());
  std::vector<Comparison> comparisons;
  std::vector<VerifiedCase> extension, shear;
  for (const CubeCase& c : cube_cases()) {
    auto& cases = is_extension(c) ? extension : shear;
    const VerifiedCase& v = cases.emplace_back(verify_case(c));
    print_case(v, screen);
    for (Comparison& entry : compare(v)) comparisons.push_back(std::move(entry));
  }
  for (const auto* cases : {&extension, &shear}) {
    write_table(folder, *cases);
    write_figure(folder, *cases);
  }
  report(folder, comparisons, screen);
  std::fprintf(
      screen,
      "\nKnown exception: without exclusion of fibres the 256 directions themselves are 0.62 %% off the density in\n"
      "the smallest shears, where the stress is 2 %% of the largest; the pointwise bound there is %.2f %%.\n"
      "Elements and analytic solution also differ by the finite bulk modulus, 0.15 %% in the extension.\n",
      100.0 * open_shear_bound);
  const auto failed = std::count_if(comparisons.begin(), comparisons.end(), [](const auto& c) { return !c.passed(); });
  std::fprintf(screen, "%s: %zu of %zu comparisons passed; tables and figures in %s\n", failed == 0 ? "PASS" : "FAIL",
               comparisons.size() - static_cast<std::size_t>(failed), comparisons.size(), folder.c_str());
  return failed == 0;
}

}  // namespace tunica::stages
