// boundary: what the conditions of the main equation become, face by face. The three sources of this class are those of
// all faces, of the blood's and of the wall's.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tunica/peer_cases/problem.hpp"

namespace tunica::peer_cases {

enum class ConditionType { dirichlet, neumann, traction, robin };
enum class Dependence { steady, unsteady, spatial, general, resistance, rcr, coupled };

/// One condition of the main equation, and where it acts.
struct ConditionPart {
  const Entry& entry;  ///< Add_BC
  const FacePart& face;
  ConditionType type;
  Dependence time;
  std::vector<double> value;  ///< of the key Value; 0 where there is none
  /// Another Add_BC of the same wall face: Dir 0 along some axes, beside this load or this motion along other axes.
  const Entry* held = nullptr;

  double scalar() const { return value.empty() ? 0.0 : value[0]; }
  bool vanishes() const {
    return time == Dependence::steady && std::all_of(value.begin(), value.end(), [](double v) { return v == 0; });
  }
};

class Conditions {
 public:
  Conditions(Context& context, const PosedProblem& problem, CaseKey& boundary)
      : context_(context), problem_(problem), boundary_(boundary) {}

  void translate();

 private:
  void translate(const Entry& condition);
  std::optional<ConditionPart> part_of(const Entry& condition);
  void translate(const ConditionPart& part);
  /// The condition beside the load or the motion of a wall face that holds the face along some other axes; none where
  /// there is another one, or more.
  const Entry* held_beside(const Entry& load) const;
  void refuse_second(const Entry& condition);
  void warn_of_idle_course(const ConditionPart& part);
  void check_mesh_equation();
  void natural(const FacePart& part);

  void lumen_velocity(const ConditionPart& part);
  void lumen_flow(const ConditionPart& part);
  void lumen_velocity_in_time(const ConditionPart& part);
  void lumen_velocity_along(const ConditionPart& part, const std::vector<int>& along);
  void add_directions(const ConditionPart& part, const std::vector<int>& along, CaseKey& to);
  void lumen_velocity_of_shape(const ConditionPart& part);
  /// Notes values that are to be written, into the file `name` beside the case; `table` says where they are.
  void nodal_table(const ConditionPart& part, const std::string& name, const char* unit, NodalValues values,
                   CaseKey& table);
  /// The text file of a condition in time and space; none where that has been reported.
  const Entry* file_in_time(const ConditionPart& part);
  /// The profile that the peer multiplies the value of a condition by.
  NodalValues shape_of(const ConditionPart& part, bool zero_rim);
  /// Has a load a profile that is not 1 everywhere?
  bool has_shape(const ConditionPart& part) const;
  void lumen_pressure(const ConditionPart& part);
  void outlet(const ConditionPart& part);
  void zerod_outlet(const ConditionPart& part);
  void wall_motion(const ConditionPart& part);
  std::vector<int> with_held(const ConditionPart& part) const;
  void wall_pressure(const ConditionPart& part);
  void moved_by_nodes(const ConditionPart& part);
  /// Of both: how the load goes with the face, and what holds it beside.
  void lay_on_wall(const ConditionPart& part, CaseKey& load);
  void pressure_by_nodes(const ConditionPart& part);
  void traction(const ConditionPart& part);
  void traction_by_nodes(const ConditionPart& part, const Entry& file);
  void traction_in_time(const ConditionPart& part);
  void support(const ConditionPart& part);

  CaseKey& face(const ConditionPart& part) { return boundary_.section(part.entry.label, part.entry.where()); }
  /// Value or table of a time course, in that unit; none: a factor.
  void course(const ConditionPart& part, const char* unit, CaseKey& to);
  /// Path of the file of a table.
  std::string file_of(const Entry& file);
  bool table(const ConditionPart& part, const char* unit, CaseKey& to);
  /// Axes of Effective_direction; none where it is not there, or names all.
  std::vector<int> axes(const Entry& condition) const;
  void add_held(const ConditionPart& part, CaseKey& load);
  bool profile_is(const ConditionPart& part, const char* wanted) const {
    return context_.text(part.entry, "Profile", "Flat") == wanted;
  }
  /// Loads of supports and tractions are the same on the whole face.
  void check_load(const ConditionPart& part);

  Context& context_;
  const PosedProblem& problem_;
  CaseKey& boundary_;
  std::vector<const Entry*> done_;
};

/// "[x, y]".
std::string names_of(const std::vector<int>& axes);
/// "[size, zero, zero]" of the axis x.
std::string along_axes(const std::vector<int>& axes, const std::string& size, const std::string& zero);

}  // namespace tunica::peer_cases
