#include "tunica/artifacts/plausible_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/text.hpp"
#include "tunica/base/units.hpp"
#include "tunica/case/plausible.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::artifacts {

namespace {

constexpr double fastest = 5, slowest = 1e-5;  // m/s, mean over the opening at the peak
constexpr double most_flow = 1e-3;             // m^3/s: more is warned of where it is read

double area(const mesh::MeshData& data, const mesh::FaceData& face) {
  double sum = 0;
  for (const auto& t : face.triangles) sum += norm(mesh::area_vector(data.points, t));
  return sum;
}

void check_flow(const bc::Flow& flow, double face_area, const std::string& where, std::vector<Problem>& warnings) {
  const double largest = case_file::largest_size(flow.course), velocity = largest / face_area;
  if (largest > most_flow || largest == 0 || (velocity >= slowest && velocity <= fastest)) return;
  warnings.push_back(
      {where,
       fmt::format("a flow of {:.4g} ml/s through an opening of {:.4g} mm2 is {:.3g} m/s on average over "
                   "it; {:.0e} m/s to {:.0f} m/s is usual",
                   1e6 * largest, 1e6 * face_area, velocity, slowest, fastest),
       "a slip of the unit of the flow, or of `length_unit`?"});
}

/// A velocity that leads out of the vessel where blood usually enters.
void check_velocity(const bc::Velocity& velocity, const mesh::MeshData& data, const mesh::FaceData& face,
                    std::vector<Problem>& warnings) {
  if (text::lower(face.name).find("inlet") == std::string::npos) return;
  double outward = 0;
  for (const auto& t : face.triangles) outward += dot(velocity.value, mesh::area_vector(data.points, t));
  outward *= bc::make_waveform(velocity.course).mean();
  if (outward > 0)
    warnings.push_back(
        {"boundary." + face.name,
         fmt::format("the velocity carries {:.4g} ml/s out of the vessel on average; blood usually flows "
                     "in there",
                     1e6 * outward),
         "the wrong sign?"});
}

struct UsualArray {
  const char* key;
  bc::SupportValue bc::Support::*value;
  double low, high;  ///< SI, as for typed values
  const char* text;
};
constexpr UsualArray usual_arrays[] = {
    {"stiffness", &bc::Support::stiffness, 1e3, 1e12, "1e3 N/m^3 to 1e12 N/m^3"},
    {"damping", &bc::Support::damping, 0, 1e12, "0 to 1e12 N s/m^3"},
    {"pressure", &bc::Support::pressure, -100 * unit::mmHg, 100 * unit::mmHg, "-100 mmHg to 100 mmHg"}};

void check_support(const bc::Support& support, const std::string& face, const mesh::MeshData& data,
                   std::vector<Problem>& warnings) {
  for (const auto& usual : usual_arrays) {
    const auto* array = std::get_if<bc::FaceArray>(&(support.*usual.value));
    if (!array) continue;
    const auto field = std::find_if(data.node_fields.begin(), data.node_fields.end(), [&](const mesh::NodeField& f) {
      return f.name == mesh::face_array_name(face, array->name);
    });
    if (field == data.node_fields.end()) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double v : field->values)
      if (!std::isnan(v)) low = std::min(low, v * array->unit), high = std::max(high, v * array->unit);
    if (low > high || (high <= usual.high && high >= usual.low && low >= std::min(usual.low, 0.0))) continue;
    warnings.push_back({fmt::format("boundary.{}.support.{}", face, usual.key),
                        fmt::format("the array {} goes from {:.4g} to {:.4g} in SI units; {} is usual", array->name,
                                    low, high, usual.text),
                        "a slip of its `unit`?"});
  }
}

}  // namespace

std::vector<Problem> implausible_on_faces(const case_file::Case& c, const mesh::MeshData& data) {
  std::vector<Problem> warnings;
  for (const auto& [name, condition] : c.boundary)
    for (const auto& face : data.faces) {
      if (face.name != name) continue;
      if (const auto* flow = std::get_if<bc::Flow>(&condition))
        check_flow(*flow, area(data, face), "boundary." + name, warnings);
      if (const auto* velocity = std::get_if<bc::Velocity>(&condition)) check_velocity(*velocity, data, face, warnings);
      if (const auto* support = std::get_if<bc::Support>(&condition)) check_support(*support, name, data, warnings);
    }
  return warnings;
}

}  // namespace tunica::artifacts
