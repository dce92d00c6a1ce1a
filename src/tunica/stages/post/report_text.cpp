#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tunica/stages/post/report_json.hpp"

namespace tunica::stages::post {

namespace {

using nlohmann::ordered_json;

/// A number, or "-" for one that is none.
std::string number(const ordered_json& value, int width, int digits) {
  return value.is_number() ? fmt::format("{:>{}.{}f}", value.get<double>(), width, digits)
                           : fmt::format("{:>{}}", "-", width);
}

std::string openings_text(const ordered_json& r) {
  std::string text = fmt::format("\n{:<28}{:>10}{:>10}{:>8}{:>12}{:>9}\n", "opening", "systolic", "diastolic", "mean",
                                 "mean flow", "share");
  for (const auto& o : r["openings"]) {
    const auto& p = o["pressure"];
    text += fmt::format("{:<28}{}{}{} mmHg{} ml/s", o["name"].get<std::string>(), number(p["systolic_mmHg"], 8, 1),
                        number(p["diastolic_mmHg"], 9, 1), number(p["mean_mmHg"], 8, 1),
                        number(o["flow_outwards"]["mean_ml_s"], 9, 2));
    if (o.contains("share_of_outflow")) text += fmt::format("{:>7.1f} %", 100 * o["share_of_outflow"].get<double>());
    text += "\n";
  }
  return text;
}

std::string stress_text(const ordered_json& r) {
  std::string text = "\nstress at the peak [kPa], by volume\n";
  std::size_t width = 18;
  for (const auto& part : r["stress"]) width = std::max(width, part["name"].get<std::string>().size());
  for (const auto& part : r["stress"])
    for (const auto& [key, value] : part.items()) {
      if (!value.is_object()) continue;
      text += fmt::format("  {:<{}}{:<28}", part["name"].get<std::string>(), width + 2, key);
      for (const auto& [percentile, stress] : value["at_peak"].items())
        text += fmt::format("  {} {}", percentile, number(stress, 7, 2));
      text += "\n";
    }
  return text;
}

std::string lumens_text(const ordered_json& r) {
  std::string text;
  if (r.contains("tears")) {
    text += fmt::format("\ntears: volume into and out of the false lumen over the window{}\n",
                        r["false_lumen"]["flows_from"] == "cuts" ? ", by cuts" : "");
    for (const auto& t : r["tears"])
      text += fmt::format("  {:<10} at {} mm  area {} mm2  in {} ml  out {} ml{}\n", t["name"].get<std::string>(),
                          number(t["distance_mm"], 6, 1), number(t["area_mm2"], 7, 1),
                          number(t["volume_into_false_lumen_ml"], 7, 3),
                          number(t["volume_out_of_false_lumen_ml"], 7, 3), t["entry"].get<bool>() ? "  (entry)" : "");
    const auto& f = r["false_lumen"];
    const auto& closed = f["mass_balance"]["largest_residual_of_largest_flow"];
    if (closed.is_null())
      text += "  no blood flows in the false lumen: less than a millionth of what enters the vessel passes its tears\n";
    else
      text +=
          fmt::format("  ejection fraction of the false lumen {}; mass balance closed to {} % of the largest flow\n",
                      number(f["ejection_fraction"], 0, 3), number(100 * closed.get<double>(), 0, 4));
  }
  double least = 0, most = 0;
  bool any = false;
  for (const auto& s : r.value("stations", ordered_json::array())) {
    if (!s.contains("true_minus_false_pressure")) continue;
    const double d = s["true_minus_false_pressure"]["mean_mmHg"].get<double>();
    least = any ? std::min(least, d) : d;
    most = any ? std::max(most, d) : d;
    any = true;
  }
  if (any)
    text += fmt::format(
        "pressure of the true less that of the false lumen, mean over the window: {:.2f} to {:.2f} mmHg "
        "along the aorta\n",
        least, most);
  if (r.contains("flap"))
    text += fmt::format("flap: moves by {} mm at most, {} mm in the mean\n",
                        number(r["flap"]["largest_displacement_mm"], 0, 3),
                        number(r["flap"]["largest_mean_displacement_mm"], 0, 3));
  return text;
}

}  // namespace

std::string report_text(const ordered_json& r) {
  std::string text =
      fmt::format("window {:.6g} s to {:.6g} s, {} fields; peak at {:.6g} s\n", r["window"]["from_s"].get<double>(),
                  r["window"]["until_s"].get<double>(), r["window"]["fields"].get<int>(), r["peak_s"].get<double>());
  if (r.contains("openings")) text += openings_text(r);
  if (r.contains("wall_shear")) {
    const auto& w = r["wall_shear"];
    text += fmt::format("\nwall shear: TAWSS {} Pa in the mean, median {} Pa, 99 % below {} Pa; OSI {} in the mean\n",
                        number(w["tawss_Pa"]["mean"], 0, 3), number(w["tawss_Pa"]["p50"], 0, 3),
                        number(w["tawss_Pa"]["p99"], 0, 3), number(w["osi"]["mean"], 0, 3));
  }
  if (r.contains("stress")) text += stress_text(r);
  text += lumens_text(r);
  for (const auto& part : r["left_out"])
    text += fmt::format("left out: {} ({})\n", part["part"].get<std::string>(), part["why"].get<std::string>());
  return text;
}

}  // namespace tunica::stages::post
