// How trustworthy directions are, region by region.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::stages::fibres {

struct ReportInput {
  const mesh::MeshData& data;  ///< with the arrays of fibres.hpp
  std::vector<std::string> inlet, outlets;
  int iterations = 0;
  std::int64_t undefined = 0, tear_elements = 0;
  int ranks = 1;
  std::vector<std::pair<std::string, double>> seconds{};  ///< of each phase
  double peak_memory = 0;                                 ///< of rank 0 [byte]
};
nlohmann::json fibres_report(const ReportInput& input);
/// The same for the terminal.
std::string report_text(const nlohmann::json& report);

}  // namespace tunica::stages::fibres
