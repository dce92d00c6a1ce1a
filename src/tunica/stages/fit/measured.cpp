#include "tunica/stages/fit/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages {

namespace {

using case_file::FitTest, case_file::MeasuredDeformation, case_file::MeasuredStress;
using fitting::Protocol, fitting::Row;

constexpr double smallest_stretch = 0.05, largest_stretch = 5.0;
constexpr std::size_t fewest_rows = 3;  // two points are a straight line, whatever the law

/// One test of one specimen.
class Table {
 public:
  Table(const std::string& specimen, const std::string& name, const FitTest& test)
      : specimen_(specimen),
        name_(name),
        test_(test),
        shear_(std::holds_alternative<case_file::ShearTest>(test.loading)),
        text_(files::read_table(test.file, "give a header line and lines of numbers")) {}

  void append_to(std::vector<Protocol>& protocols) const {
    refuse_other_unit();
    std::vector<std::pair<double, std::vector<Row>>> groups;
    const auto protocol = column(test_.protocol), cycle = test_.cycles ? column(test_.cycles->column) : std::nullopt;
    std::vector<std::vector<double>> cycle_numbers;
    for (const files::TableRow& row : text_.rows) {
      const double number = protocol ? value(row, *protocol) : 0.0;
      auto at = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == number; });
      if (at == groups.end()) {
        at = groups.insert(groups.end(), {number, {}});
        cycle_numbers.emplace_back();
      }
      at->second.push_back(measured_row(row));
      cycle_numbers[static_cast<std::size_t>(at - groups.begin())].push_back(cycle ? value(row, *cycle) : 0.0);
    }
    refuse_implausible(groups);
    for (std::size_t k = 0; k < groups.size(); ++k) {
      Protocol p = empty_protocol();
      if (protocol) p.name += fmt::format(" {:g}", groups[k].first);
      p.rows = test_.cycles ? kept(groups[k].second, cycle_numbers[k], cycle.has_value()) : groups[k].second;
      refuse_short(p);
      protocols.push_back(std::move(p));
    }
    if (groups.empty())
      throw InputError(test_.file.string(), "has no measured point", "give lines of numbers below the header");
  }

 private:
  std::optional<std::size_t> column(const std::optional<std::string>& header) const {
    if (!header) return std::nullopt;
    return text_.find(*header);
  }

  double value(const files::TableRow& row, std::size_t c) const {
    const std::string cell = text::lower(row.cells[c]);
    if (cell.empty() || cell == "nan" || cell == "inf" || cell == "-inf" || cell == "na")
      throw InputError(
          text_.where(row.line),
          fmt::format("'{}' under '{}' is no measured value", text::printable(row.cells[c]), text_.headers[c]),
          "remove the row, or start it with # to leave it out");
    return text_.number(row, c);
  }

  double stretch(const files::TableRow& row, const std::string& header) const {
    const std::size_t c = text_.find(header);
    const double given = value(row, c);
    double stretch = given;
    if (test_.deformation == MeasuredDeformation::engineering_strain) stretch = 1.0 + given;
    if (test_.deformation == MeasuredDeformation::green_lagrange_strain)
      stretch = 1.0 + 2.0 * given > 0.0 ? std::sqrt(1.0 + 2.0 * given) : -1.0;
    if (!(stretch > smallest_stretch))
      throw InputError(text_.where(row.line),
                       fmt::format("'{}' under '{}' is a stretch of {:.4g}; a stretch is above {}", row.cells[c],
                                   header, stretch, smallest_stretch),
                       test_.deformation == MeasuredDeformation::stretch
                           ? "a stretch is 1 at rest: for strains, which are 0 there, say `deformation: "
                             "engineering_strain` or `green_lagrange_strain`"
                           : "check the sign and what the column holds: strains are 0 at rest");
    if (!(stretch < largest_stretch))
      throw InputError(text_.where(row.line),
                       fmt::format("'{}' under '{}' is a stretch of {:.4g}; tissue does not bear more than {}",
                                   row.cells[c], header, stretch, largest_stretch),
                       "a stretch is 1 at rest and strains are 0: divide percent by 100 and check `deformation`");
    return stretch;
  }

  Mat3<double> gradient(const files::TableRow& row, double tolerance) const {
    Mat3<double> F{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F(i, j) = value(row, text_.find(fmt::format("F{}{}", i + 1, j + 1)));
    if (const double J = determinant(F); !(std::abs(J - 1.0) <= tolerance))
      throw InputError(
          text_.where(row.line),
          fmt::format("F11 ... F33 have the determinant {:.4g}, but tissue keeps its volume to {:g}", J, tolerance),
          "check the columns, leave the row out by # at its start, or set `volume_tolerance`");
    return F;
  }

  Row measured_row(const files::TableRow& row) const {
    Row r{.line = row.line};
    if (const auto* gradients = std::get_if<case_file::MeasuredGradients>(&test_.loading)) {
      r.F = gradient(row, gradients->volume_tolerance);
      r.along = std::hypot((*r.F)(0, 0), (*r.F)(1, 0));
    } else {
      r.along = shear_ ? value(row, text_.find(*test_.load)) : stretch(row, *test_.load);
    }
    if (test_.load_across) r.across = stretch(row, *test_.load_across);
    const double factor = test_.factor();
    r.stress[0] = value(row, text_.find(test_.stress)) * factor / test_.section.value_or(1.0);
    if (test_.stress_across)
      r.stress[1] = value(row, text_.find(*test_.stress_across)) * factor / test_.section_across.value_or(1.0);
    return r;
  }

  Protocol empty_protocol() const {
    Protocol p{.specimen = specimen_, .name = name_, .file = test_.file.string()};
    p.weight = test_.weight;
    p.test = name_;
    p.second_stress = test_.stress_across.has_value();
    p.measure = test_.measure == MeasuredStress::cauchy                   ? wall::StressMeasure::cauchy
                : test_.measure == MeasuredStress::second_piola_kirchhoff ? wall::StressMeasure::second_piola_kirchhoff
                                                                          : wall::StressMeasure::first_piola_kirchhoff;
    const std::string where = "specimens." + specimen_ + ".tests." + name_;
    if (const auto* strip = std::get_if<case_file::PulledStrip>(&test_.loading)) {
      p.loading = fitting::Loading::uniaxial;
      p.axes = wall::specimen_axes(case_file::vector_of(strip->along));
      return p;
    }
    const auto sheet = [&](const case_file::SheetAxes& s, fitting::Loading loading) {
      p.loading = loading;
      p.axes = wall::orthonormal_frame(case_file::vector_of(s.along), case_file::vector_of(s.across), where);
    };
    if (const auto* biaxial = std::get_if<case_file::BiaxialTest>(&test_.loading)) {
      sheet(*biaxial, fitting::Loading::biaxial);
      p.load_ratio = biaxial->load_ratio;
    } else if (const auto* planar = std::get_if<case_file::PlanarTest>(&test_.loading)) {
      sheet(*planar, fitting::Loading::planar);
    } else if (const auto* shear = std::get_if<case_file::ShearTest>(&test_.loading)) {
      sheet(*shear, fitting::Loading::simple_shear);
    } else {
      p.loading = fitting::Loading::gradients;
      p.axes = wall::ConstantFrame{}.frame();
    }
    return p;
  }

  /// A header that names another unit than the case.
  void refuse_other_unit() const {
    constexpr const char* units[] = {"GPa", "MPa", "kPa", "Pa", "mmHg", "kN", "mN", "N"};
    for (const auto& header : {std::optional(test_.stress), test_.stress_across}) {
      if (!header) continue;
      for (const std::string unit : units) {
        const auto named = [&](const std::string& ending) { return header->ends_with(ending); };
        if (!named("_" + unit) && !named("[" + unit + "]") && !named("(" + unit + ")") && !named(" " + unit)) continue;
        if (unit == test_.unit) break;
        throw InputError(fmt::format("{}:{}", test_.file.string(), text_.header_line),
                         fmt::format("the header '{}' names {}, the case says `unit: {}`", *header, unit, test_.unit),
                         "let the case name the unit that the file is in");
      }
    }
  }

  /// Stresses that no test of soft tissue reaches, or that none can measure: a slip of the unit.
  void refuse_implausible(const std::vector<std::pair<double, std::vector<Row>>>& groups) const {
    const Row* peak = nullptr;
    double largest = 0.0;
    for (const auto& [number, rows] : groups)
      for (const Row& r : rows)
        for (const double s : r.stress)
          if (std::abs(s) >= largest) largest = std::abs(s), peak = &r;
    constexpr double lowest = 100.0, highest = 2e7;  // Pa
    if (peak == nullptr || (largest >= lowest && largest <= highest)) return;
    throw InputError(
        text_.where(peak->line),
        fmt::format("the largest stress of the test is {:.4g} Pa, taken as {}; {:.0f} Pa to {:.0f} MPa are "
                    "expected of a wall",
                    largest, test_.unit, lowest, highest * 1e-6),
        "check `unit`" + std::string(test_.section ? " and `section`" : ""));
  }

  void refuse_short(const Protocol& p) const {
    if (p.rows.size() >= fewest_rows) return;
    const std::string lines = p.rows.empty()      ? "none"
                              : p.rows.size() > 1 ? fmt::format("lines {} and {}", p.rows[0].line, p.rows[1].line)
                                                  : fmt::format("line {}", p.rows[0].line);
    throw InputError(p.rows.empty() ? test_.file.string() : text_.where(p.rows.front().line),
                     fmt::format("the protocol '{}' of specimen '{}' has {} row{} ({})", p.name, specimen_,
                                 p.rows.size(), p.rows.size() == 1 ? "" : "s", lines),
                     fmt::format("give at least {}, or leave the protocol out by # at its lines; check `protocol` and "
                                 "`cycles`",
                                 fewest_rows));
  }

  /// Numbers of cycles by where the stretch turns from falling to rising, by more than a fifth of its range.
  static std::vector<double> counted(const std::vector<Row>& rows) {
    const auto load = [](const Row& r) { return r.along + r.across.value_or(0.0); };
    double low = load(rows.front()), high = low;
    for (const Row& r : rows) low = std::min(low, load(r)), high = std::max(high, load(r));
    const double turn = 0.2 * (high - low);
    std::vector<double> numbers(rows.size(), 1.0);
    double cycle = 1.0, extreme = load(rows.front());
    bool rising = true;
    std::size_t lowest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double x = load(rows[i]);
      if (rising ? x > extreme : x < extreme) {
        extreme = x;
        lowest = i;
      } else if (rising && x < extreme - turn) {
        rising = false;
        extreme = x;
        lowest = i;
      } else if (!rising && x > extreme + turn) {
        rising = true;
        cycle += 1.0;
        for (std::size_t j = lowest; j < i; ++j) numbers[j] = cycle;
        extreme = x;
      }
      numbers[i] = cycle;
    }
    return numbers;
  }

  std::vector<Row> kept(const std::vector<Row>& rows, const std::vector<double>& given, bool has_column) const {
    const case_file::Cycles& rule = *test_.cycles;
    const std::vector<double> numbers = has_column ? given : counted(rows);
    std::vector<double> order;
    for (const double n : numbers)
      if (std::find(order.begin(), order.end(), n) == order.end()) order.push_back(n);
    std::vector<Row> result;
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k < static_cast<std::size_t>(rule.drop) || (rule.last_only && k + 1 < order.size())) continue;
      std::vector<Row> cycle;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (numbers[i] == order[k]) cycle.push_back(rows[i]);
      const auto top = std::max_element(cycle.begin(), cycle.end(), [](const Row& a, const Row& b) {
        return a.along + a.across.value_or(0.0) < b.along + b.across.value_or(0.0);
      });
      auto first = cycle.begin(), last = cycle.end();
      if (rule.branch == case_file::Branch::loading) last = top + 1;
      if (rule.branch == case_file::Branch::unloading) first = top;
      result.insert(result.end(), first, last);
    }
    return result;
  }

  const std::string &specimen_, &name_;
  const FitTest& test_;
  bool shear_;
  files::TextTable text_;
};

}  // namespace

std::vector<fitting::Protocol> read_protocols(const case_file::FitCase& c) {
  std::vector<Protocol> protocols;
  std::vector<Problem> problems;
  for (const auto& [specimen, s] : c.specimens)
    for (const auto& [name, test] : s.tests) try {
        Table(specimen, name, test).append_to(protocols);
      } catch (const InputError& error) {
        problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      }
  if (!problems.empty()) throw InputError(std::move(problems));
  return protocols;
}

}  // namespace tunica::stages
