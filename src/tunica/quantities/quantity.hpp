// Fields that results can have, by name. Each stands in a file of this folder and in one line of registry.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tunica/coupling/problem.hpp"
#include "tunica/quantities/moment.hpp"

namespace tunica::quantities {

/// What the unit of a quantity is: one of those that a case chooses for its results, or always the same.
enum class Unit { length, velocity, pressure, stress, pascal, per_second, metre_per_second_squared, none };

/// Where the values of a quantity lie, and how the mesh's numbers count them.
enum class Place {
  nodes,          ///< all local nodes of the mesh
  lumen_nodes,    ///< all local nodes of the mesh; those of a lumen region mean something
  wall_nodes,     ///< likewise of a wall region
  wall_elements,  ///< owned elements of a wall region
};

/// Values [SI] at the place of a quantity. Component c of entry n is values[n * stride + c].
struct Values {
  std::string name;                ///< added to that of the quantity: " 2", the second of several of its kind
  std::vector<double> own{};       ///< where the values were computed; empty where they are seen elsewhere
  std::span<const double> seen{};  ///< in the state that was asked
  int stride = 1;
  std::span<const double> values() const { return own.empty() ? seen : std::span<const double>(own); }
};

/// Numbers of their own: entry n has values[n * columns] and the following ones.
struct Table {
  std::size_t columns = 1;
  std::vector<double> values;
};

struct Quantity {
  std::string key;   ///< in case files: "von_mises_stress"
  std::string name;  ///< in results: "von Mises stress"
  std::string help;  ///< a line of text
  Unit unit = Unit::none;
  Place place = Place::nodes;
  int components = 1;      ///< 1, 3 (vector), or 9 (tensor, row by row)
  bool standard = false;   ///< written where a case names no fields
  bool of_motion = false;  ///< not in statics
  bool (*given)(const coupling::Problem& problem) = [](const coupling::Problem&) { return true; };  ///< by its kind
  /// Values in a region (the first where the place is that of all nodes). Collective. Nodes of other ranks are up to
  /// date.
  std::function<std::vector<Values>(Moment& moment, std::size_t region)> values;
};

/// All of them, in the order in which results have them.
const std::vector<Quantity>& registry();

/// By key; none when there is no such quantity.
const Quantity* find(const std::string& key);

/// All values of a quantity of so many components, those of several arrays one after the other in a row.
Table table_of(const std::vector<Values>& arrays, int components, std::size_t entries);

/// Values as a field of the state has them, from its component `first` on.
inline std::vector<Values> seen(const std::vector<double>& field, int stride, std::size_t first = 0) {
  std::vector<Values> result(1);
  result[0].seen = std::span(field).subspan(field.empty() ? 0 : first);
  result[0].stride = stride;
  return result;
}

inline bool has_wall(const coupling::Problem& problem) { return problem.input().wall.has_value(); }

/// Values of one array of `components` numbers for each owned element of a wall region: `of(point, out)` writes those
/// of one element.
template <class Of>
std::vector<Values> for_wall_elements(Moment& moment, std::size_t region, int components, const Of& of) {
  const auto& points = moment.wall_points(region);
  std::vector<Values> result(1);
  result[0].stride = components;
  result[0].own.resize(points.size() * static_cast<std::size_t>(components));
  for (std::size_t e = 0; e < points.size(); ++e)
    of(points[e], result[0].own.data() + e * static_cast<std::size_t>(components));
  return result;
}

/// A tensor to `out`, row by row.
inline void put(const Mat3<double>& tensor, double* out) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[3 * i + j] = tensor(i, j);
}

}  // namespace tunica::quantities
