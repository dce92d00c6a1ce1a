#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/config/units.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/stages/fit/fit.hpp"

namespace tunica::stages {

namespace {

namespace page = drawing::page;
using fitting::Identification, fitting::Protocol;

std::string r_squared(const fitting::Deviation& d) { return d.r_squared ? fmt::format("{:.4f}", *d.r_squared) : "–"; }

std::string ranking(const std::vector<FittedModel>& ranked, double per_pascal, const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  for (const FittedModel& f : ranked) {
    double squares = 0.0, values = 0.0;
    for (std::size_t k = 0; k < f.held_out.size(); ++k)
      if (f.held_out[k]) {
        const double n = static_cast<double>(f.model.protocols()[k].values());
        squares += n * f.held_out[k]->rms * f.held_out[k]->rms;
        values += n;
      }
    rows.push_back({page::escaped(f.name), std::to_string(f.fit.x.size()), r_squared(f.fit.overall),
                    fmt::format("{:.3g}", f.fit.overall.rms * per_pascal),
                    values > 0.0 ? fmt::format("{:.3g}", std::sqrt(squares / values) * per_pascal) : "–",
                    fmt::format("{:.1f}", f.criteria.aic - ranked.front().criteria.aic),
                    fmt::format("{:.1f}", f.criteria.bic - ranked.front().criteria.bic)});
  }
  return page::table(
             {"law", "parameters", "R²", fmt::format("RMSE [{}]", unit),
              fmt::format("RMSE of protocols left out [{}]", unit), "AIC above the first", "BIC above the first"},
             rows) +
         "<p>AIC and BIC count residuals by how many of them are independent. A protocol left out is predicted by the "
         "law fitted to the others.</p>\n";
}

std::string parameters(const FittedModel& f) {
  std::vector<std::vector<std::string>> rows;
  const auto values = f.model.values(f.fit.x);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const fitting::Parameter& p = f.model.parameter(i);
    const fitting::Determination& d = f.uncertainty.unknowns[i];
    const auto interval = [&](const fitting::Interval& x) {
      return p.text(p.value(x.low), 3) + " to " + p.text(p.value(x.high), 3);
    };
    rows.push_back({page::escaped(f.model.unknowns()[i].name), p.text(values[i]), "<b>" + interval(d.interval) + "</b>",
                    interval(d.bootstrap),
                    (d.open_below ? "≤ " : "") + interval(d.profile) + (d.open_above ? " ≤" : ""),
                    d.identification == Identification::identified ? "identified"
                    : d.identification == Identification::weak     ? "weakly"
                                                                   : "<b>not identified</b>"});
  }
  return page::table({"parameter", "value", "95 %", "by bootstrap", "by profile", ""}, rows);
}

std::string correlations(const FittedModel& f) {
  std::vector<std::string> head{"correlation"};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < f.fit.x.size(); ++i) {
    head.push_back(page::escaped(f.model.unknowns()[i].name));
    auto& row = rows.emplace_back(std::vector<std::string>{page::escaped(f.model.unknowns()[i].name)});
    for (std::size_t j = 0; j < f.fit.x.size(); ++j)
      row.push_back(fmt::format("{:+.2f}", f.uncertainty.correlation[i][j]));
  }
  return page::table(head, rows);
}

std::string protocol_plot(const FittedModel& f, std::size_t k, double per_pascal, const std::string& unit) {
  const Protocol& p = f.model.protocols()[k];
  std::vector<drawing::Series> series;
  for (std::size_t c = 0; c < p.components(); ++c) {
    drawing::Series points{.name = c == 0 ? "measured" : "measured across",
                           .line = false,
                           .markers = true,
                           .hollow = true,
                           .colour = static_cast<int>(c)},
        law{.name = c == 0 ? f.name : f.name + " across", .colour = static_cast<int>(c)};
    for (std::size_t i = 0; i < p.rows.size(); ++i) {
      const double x = c == 1 && p.rows[i].across ? *p.rows[i].across : p.rows[i].along;
      points.x.push_back(x);
      law.x.push_back(x);
      points.y.push_back(p.rows[i].stress[c] * per_pascal);
      law.y.push_back(f.fit.predicted[k][i * p.components() + c] * per_pascal);
    }
    series.push_back(std::move(points));
    series.push_back(std::move(law));
  }
  drawing::PlotOptions options;
  options.title = p.specimen + ", " + p.name;
  options.x_label = p.loading == fitting::Loading::simple_shear ? "amount of shear" : "stretch of the axis";
  options.y_label = fmt::format("{} [{}]", wall::name_of(p.measure), unit);
  return page::drawing(drawing::draw_plot(series, options));
}

std::string profile_plot(const FittedModel& f, std::size_t i) {
  const fitting::Parameter& p = f.model.parameter(i);
  drawing::Series curve{.name = "", .markers = true}, level{.name = "95 %", .dashed = true, .colour = 1};
  for (const fitting::ProfilePoint& point : f.uncertainty.unknowns[i].points) {
    const double x = p.value(point.x[i]) / p.per_unit();
    curve.x.push_back(x);
    curve.y.push_back(std::max(f.fit.excess(point.squares), 0.0));
    level.x.push_back(x);
    level.y.push_back(std::pow(fitting::student_95(f.fit.degrees_of_freedom()), 2));
  }
  drawing::PlotOptions options;
  options.title = "profile of " + f.model.unknowns()[i].name;
  options.x_label = p.unit().empty() ? p.name : fmt::format("{} [{}]", p.name, p.unit());
  options.y_label = "misfit above the least, in variances";
  return page::drawing(drawing::draw_plot({curve, level}, options));
}

std::string protocol_table(const FittedModel& f, double per_pascal, const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < f.fit.by_protocol.size(); ++k) {
    const Protocol& p = f.model.protocols()[k];
    rows.push_back({page::escaped(p.specimen), page::escaped(p.name), fitting::name_of(p.loading),
                    std::to_string(p.rows.size()), r_squared(f.fit.by_protocol[k]),
                    fmt::format("{:.3g}", f.fit.by_protocol[k].rms * per_pascal),
                    f.held_out[k] ? r_squared(*f.held_out[k]) : "–"});
  }
  return page::table({"specimen", "protocol", "test", "rows", "R²", fmt::format("RMSE [{}]", unit), "R² when left out"},
                     rows);
}

std::string in_vivo_table(const FittedModel& f, const case_file::InVivoStress& stress, double per_pascal,
                          const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  for (const InVivo& v : f.in_vivo) {
    if (!v.point) continue;
    auto& row = rows.emplace_back(
        std::vector<std::string>{f.in_vivo.size() > 1 ? page::escaped(v.specimen) : "all",
                                 fmt::format("{:.3f} / {:.3f}", v.point->stretch[0], v.point->stretch[1])});
    for (std::size_t k = 0; k < v.point->moduli.size(); ++k) {
      std::string text = fmt::format("{:.4g}", v.point->moduli[k] * per_pascal);
      if (k < v.moduli.size())
        text += fmt::format(" ({:.3g} to {:.3g})", v.moduli[k].low * per_pascal, v.moduli[k].high * per_pascal);
      row.push_back(std::move(text));
    }
  }
  if (rows.empty()) return "";
  return page::table({"specimen", "stretches in vivo", "circumferential modulus [" + unit + "]",
                      "longitudinal modulus [" + unit + "]", "coupling [" + unit + "]"},
                     rows) +
         fmt::format(
             "<p>In vivo: Cauchy stress {:.4g} {} circumferential, {:.4g} {} longitudinal. A modulus is the stress "
             "that "
             "a small further logarithmic strain adds with the other stretch held, the coupling what strain along the "
             "vessel adds around it; 95 % by bootstrap.</p>\n",
             stress.circumferential * per_pascal, unit, stress.longitudinal * per_pascal, unit);
}

std::string section(const FittedModel& f, const case_file::InVivoStress& stress, double per_pascal,
                    const std::string& unit) {
  std::string text = fmt::format("<h2>{}</h2>\n", page::escaped(f.name));
  for (const auto& remark : f.remarks) text += "<p class=\"missing\">" + page::escaped(remark) + "</p>\n";
  text +=
      parameters(f) +
      fmt::format(
          "<p>Bootstrap: {} replicates of blocks of {} rows; {:.1f} neighbouring rows tell as much as one independent. "
          "Profile: the parameter held, all others fitted again. {} of {} starts came so low.</p>\n",
          f.uncertainty.replicates.size(), f.uncertainty.block, f.fit.correlation.length, f.fit.agreeing_starts(),
          f.fit.start_squares.size());
  text += correlations(f) + in_vivo_table(f, stress, per_pascal, unit) + protocol_table(f, per_pascal, unit);
  for (std::size_t k = 0; k < f.fit.predicted.size(); ++k) text += protocol_plot(f, k, per_pascal, unit);
  for (std::size_t i = 0; i < f.fit.x.size(); ++i) text += profile_plot(f, i);
  text +=
      "<pre>" + page::escaped(f.model.law().yaml(f.model.values_of(f.model.specimens().front(), f.fit.x))) + "</pre>\n";
  return text;
}

}  // namespace

std::string fit_page(const case_file::FitCase& c, const std::vector<fitting::Protocol>& protocols,
                     const std::vector<FittedModel>& ranked, const std::vector<std::string>& remarks_on_data) {
  const double per_pascal = 1.0 / config::unit_factor(c.output.stress, config::dimension::pressure);
  std::string html = page::begin(c.title.empty() ? "Fit of wall laws" : c.title);
  html += fmt::format("<p>{} protocol{} of {} specimen{}.</p>\n", protocols.size(), protocols.size() == 1 ? "" : "s",
                      c.specimens.size(), c.specimens.size() == 1 ? "" : "s");
  for (const auto& remark : remarks_on_data) html += "<p class=\"missing\">" + page::escaped(remark) + "</p>\n";
  html += ranking(ranked, per_pascal, c.output.stress);
  for (const FittedModel& f : ranked) html += section(f, c.in_vivo, per_pascal, c.output.stress);
  return html + page::end();
}

}  // namespace tunica::stages
