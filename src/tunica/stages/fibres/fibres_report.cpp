#include "tunica/stages/fibres/fibres_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tunica/stages/fibres/fibres.hpp"

namespace tunica::stages::fibres {

namespace {

constexpr double large_jump = 30;  // degrees
constexpr int confidence_bins = 10;

const std::vector<double>& values(const mesh::MeshData& data, const std::string& name) {
  return std::find_if(data.fields.begin(), data.fields.end(), [&](const auto& f) { return f.name == name; })->values;
}

struct Counts {
  std::int64_t elements = 0, jumps = 0;
  double confidence = 0;
  std::vector<std::int64_t> histogram = std::vector<std::int64_t>(confidence_bins, 0);

  void add(const Counts& other) {
    elements += other.elements;
    jumps += other.jumps;
    confidence += other.confidence;
    for (int i = 0; i < confidence_bins; ++i) histogram[i] += other.histogram[i];
  }
  nlohmann::json json(const std::string& name) const {
    const auto n = static_cast<double>(elements);
    return {{"name", name},
            {"elements", elements},
            {"jump_above_30_deg_percent", 100 * static_cast<double>(jumps) / n},
            {"mean_confidence", confidence / n},
            {"confidence_histogram_0.1", histogram}};
  }
};

Counts count(const mesh::MeshData& data, const mesh::RegionData& region) {
  const auto &jump = values(data, array_jump), &confidence = values(data, array_confidence);
  Counts counts;
  for (auto e = region.first_element; e < region.end_element; ++e) {
    ++counts.elements;
    counts.jumps += jump[e] > large_jump;
    counts.confidence += confidence[e];
    ++counts.histogram[std::clamp(static_cast<int>(confidence[e] * confidence_bins), 0, confidence_bins - 1)];
  }
  return counts;
}

}  // namespace

nlohmann::json fibres_report(const ReportInput& input) {
  nlohmann::json report = {{"inlet", input.inlet},
                           {"outlets", input.outlets},
                           {"iterations", input.iterations},
                           {"elements_without_own_longitudinal_direction", input.undefined},
                           {"lumen_elements_across_tears", input.tear_elements},
                           {"ranks", input.ranks},
                           {"peak_memory_of_rank_0_MB", input.peak_memory / 1e6}};
  Counts all;
  for (const auto& region : input.data.regions) {
    if (region.kind != mesh::RegionKind::wall) continue;
    const auto counts = count(input.data, region);
    report["regions"].push_back(counts.json(region.name));
    all.add(counts);
  }
  report["wall"] = all.json("wall");
  double total = 0;
  for (const auto& [phase, seconds] : input.seconds) {
    report["seconds"][phase] = seconds;
    total += seconds;
  }
  report["seconds"]["total"] = total;
  return report;
}

std::string report_text(const nlohmann::json& r) {
  const auto names = [](const nlohmann::json& list) {
    std::string text;
    for (const auto& name : list) text += (text.empty() ? "" : ", ") + name.get<std::string>();
    return text;
  };
  std::string text =
      fmt::format("inlet: {}\noutlets: {}\n\n{:<24}{:>10}{:>16}{:>12}   {}\n", names(r["inlet"]), names(r["outlets"]),
                  "region", "elements", "jump > 30 deg", "confidence", "elements by confidence, 0 to 1 in tenths");
  const auto line = [&](const nlohmann::json& region, const std::string& name) {
    text += fmt::format("{:<24}{:>10}{:>14.2f} %{:>12.3f}  ", name, region["elements"].get<std::int64_t>(),
                        region["jump_above_30_deg_percent"].get<double>(), region["mean_confidence"].get<double>());
    for (const auto& n : region["confidence_histogram_0.1"]) text += fmt::format(" {}", n.get<std::int64_t>());
    text += "\n";
  };
  for (const auto& region : r["regions"]) line(region, region["name"]);
  line(r["wall"], "all");
  if (const auto n = r["elements_without_own_longitudinal_direction"].get<std::int64_t>(); n > 0)
    text += fmt::format("{} elements took e2 from their neighbours; their confidence is 0\n", n);
  if (const auto n = r["lumen_elements_across_tears"].get<std::int64_t>(); n > 0)
    text += fmt::format("tears: {} elements of the lumen lie across them\n", n);
  text += "\n";
  for (const auto& [phase, seconds] : r["seconds"].items())
    text += fmt::format("{}: {:.1f} s; ", phase, seconds.get<double>());
  return text + fmt::format("{} ranks, {:.0f} MB on the first\n", r["ranks"].get<int>(),
                            r["peak_memory_of_rank_0_MB"].get<double>());
}

}  // namespace tunica::stages::fibres
