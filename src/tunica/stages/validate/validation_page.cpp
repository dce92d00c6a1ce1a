#include "tunica/stages/validate/validation_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/drawing/page.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::stages::validate {

namespace page = drawing::page;

double Finding::deviation(std::size_t figure) const {
  const auto& r = benchmark.references[figure];
  const auto [low, high] = std::minmax({r.value, r.measured.value_or(r.value)});
  const double nearest = std::clamp(values[figure], low, high);
  return (values[figure] - nearest) / std::abs(r.scale != 0 ? r.scale : r.value);
}

double Finding::tolerance(std::size_t figure) const {
  const auto& r = benchmark.references[figure];
  return variant.full ? r.full : r.quick;
}

bool Finding::judged(std::size_t figure) const { return std::isfinite(tolerance(figure)); }

bool Finding::passed(std::size_t figure) const {
  return !judged(figure) || std::abs(deviation(figure)) <= tolerance(figure);
}

bool Finding::passed() const {
  if (!failure.empty() || values.size() != benchmark.references.size()) return false;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!passed(k)) return false;
  return true;
}

std::string Finding::verdict() const {
  if (!passed()) return "missed";
  for (std::size_t k = 0; k < values.size(); ++k)
    if (judged(k)) return "passed";
  return "not judged";
}

namespace {

std::string verdict_of(const Finding& f, std::size_t k) {
  return !f.judged(k) ? "not judged" : f.passed(k) ? "passed" : "missed";
}

/// What a page says, a miss in bold.
std::string marked(const std::string& verdict) { return verdict == "missed" ? "<b>missed</b>" : verdict; }

std::string tolerance_text(const Finding& f, std::size_t k) {
  return f.judged(k) ? fmt::format("{:g} %", 100 * f.tolerance(k)) : "";
}

std::string reference_text(const Reference& r) {
  return r.measured ? fmt::format("{:.5g}, measured {:.5g}", r.value, *r.measured) : fmt::format("{:.5g}", r.value);
}

}  // namespace

std::string line(const Finding& f, std::size_t k) {
  const auto& r = f.benchmark.references[k];
  const auto allowed = f.judged(k) ? fmt::format(" ({} allowed)", tolerance_text(f, k)) : "";
  return fmt::format("{}: {:.5g} {}, reference {}, {:+.2f} %{}: {}", r.name, f.values[k], r.unit, reference_text(r),
                     100 * f.deviation(k), allowed, verdict_of(f, k) == "missed" ? "MISSED" : verdict_of(f, k));
}

namespace {

std::string mesh_text(const Finding& f) {
  return fmt::format("{} tetrahedra, {}; {} ({}){}", f.elements,
                     f.variant.elements == case_file::Elements::quadratic ? "quadratic" : "linear",
                     f.step > 0 ? fmt::format("{} steps of {:g} s", f.steps, f.step) : std::string("static"),
                     f.variant.full ? "full" : "quick",
                     f.reused ? "; results that were there" : fmt::format("; {:.1f} s", f.seconds));
}

std::string section(const Finding& f) {
  std::string text = fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n<p>Reference: {}</p>\n", f.benchmark.name,
                                 page::escaped(f.benchmark.title), mesh_text(f), page::escaped(f.benchmark.source));
  if (!f.failure.empty()) return text + "<p><b>" + page::escaped(f.failure) + "</b></p>\n";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < f.values.size(); ++k) {
    const auto& r = f.benchmark.references[k];
    rows.push_back({page::escaped(r.name), fmt::format("{:.5g} {}", f.values[k], page::escaped(r.unit)),
                    reference_text(r), fmt::format("{:+.2f} %", 100 * f.deviation(k)), tolerance_text(f, k),
                    marked(verdict_of(f, k))});
  }
  text += page::table({"", "value", "reference", "deviation", "allowed", ""}, rows);
  if (f.plot) text += page::drawing(drawing::draw_plot(f.plot->series, f.plot->options));
  return text;
}

nlohmann::ordered_json to_json(const Finding& f) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < f.values.size(); ++k) {
    const auto& r = f.benchmark.references[k];
    figures.push_back({{"name", r.name},
                       {"unit", r.unit},
                       {"value", f.values[k]},
                       {"reference", r.value},
                       {"deviation", f.deviation(k)},
                       {"tolerance", f.tolerance(k)},
                       {"judged", f.judged(k)},
                       {"passed", f.passed(k)}});
    if (r.measured) figures.back()["measured"] = *r.measured;
  }
  return {{"name", f.benchmark.name}, {"source", f.benchmark.source},
          {"full", f.variant.full},   {"elements", f.elements},
          {"nodes", f.nodes},         {"steps", f.steps},
          {"step", f.step},           {"seconds", f.seconds},
          {"reused", f.reused},       {"failure", f.failure},
          {"passed", f.passed()},     {"figures", figures}};
}

}  // namespace

void write_page(const std::filesystem::path& folder, const std::vector<Finding>& findings) {
  std::string html = page::begin("Validation"),
              csv = "benchmark,figure,unit,value,reference,measured,deviation,tolerance,passed\n";
  std::vector<std::vector<std::string>> summary;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& f : findings)
    summary.push_back({fmt::format("<a href=\"#{}\">{}</a>", f.benchmark.name, f.benchmark.name),
                       page::escaped(f.benchmark.title), marked(f.verdict())});
  html += page::table({"benchmark", "", ""}, summary);
  for (const auto& f : findings) {
    html += section(f);
    json.push_back(to_json(f));
    for (std::size_t k = 0; k < f.values.size(); ++k) {
      const auto& r = f.benchmark.references[k];
      csv += fmt::format("{},\"{}\",{},{:.10g},{:.10g},{},{:.6g},{:.6g},{}\n", f.benchmark.name, r.name, r.unit,
                         f.values[k], r.value, r.measured ? fmt::format("{:.10g}", *r.measured) : "", f.deviation(k),
                         f.tolerance(k), f.passed(k) ? 1 : 0);
    }
  }
  files::write_atomically(folder / "validation.html", html + page::end());
  files::write_atomically(folder / "validation.csv", csv);
  files::write_atomically(folder / "validation.json", json.dump(2) + "\n");
}

}  // namespace tunica::stages::validate
