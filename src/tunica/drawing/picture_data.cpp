#include "tunica/drawing/picture_data.hpp"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/field_io/series_index.hpp"

namespace tunica::drawing {

namespace {

std::vector<SeriesStep> series_of_results(const std::filesystem::path& path) {
  std::vector<SeriesStep> steps;
  for (const auto& entry : field_io::read_series(path))
    steps.push_back({entry.time, {(path.parent_path() / entry.file).string()}});
  if (steps.empty()) throw InputError(path.string(), "lists no instant", "let the run write at least one output step");
  return steps;
}

}  // namespace

std::vector<SeriesStep> read_series(const std::string& file) {
  const std::filesystem::path path(file);
  if (!std::filesystem::exists(path)) throw InputError(file, "does not exist", "check the path");
  if (path.extension() == ".series") return series_of_results(path);
  if (path.extension() != ".pvd") return {SeriesStep{std::nullopt, {file}}};

  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  auto* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection) throw InputError(file, "is no ParaView collection", "give a .pvd file that lists data sets");
  std::map<double, std::vector<std::string>> steps;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    auto* data_set = collection->GetNestedElement(i);
    const char* name = data_set->GetAttribute("file");
    if (!name) continue;
    double time = 0.0;  // ParaView takes a missing time as zero too
    data_set->GetScalarAttribute("timestep", time);
    steps[time].push_back((path.parent_path() / name).string());
  }
  if (steps.empty()) throw InputError(file, "lists no data set", "let the run write at least one output step");
  std::vector<SeriesStep> result;
  for (auto& [time, files] : steps) result.push_back({time, std::move(files)});
  return result;
}

const SeriesStep& pick_step(const std::vector<SeriesStep>& steps, std::optional<double> time) {
  if (!time) return steps.back();
  return *std::min_element(steps.begin(), steps.end(), [&](const SeriesStep& a, const SeriesStep& b) {
    return std::abs(a.time.value_or(0.0) - *time) < std::abs(b.time.value_or(0.0) - *time);
  });
}

}  // namespace tunica::drawing
