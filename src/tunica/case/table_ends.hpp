// Tables of boundary values that end before the computation that asks for them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/bc/conditions.hpp"
#include "tunica/case/case.hpp"

namespace tunica::case_file {

/// The time over which a computation asks for the values of conditions.
struct AskedTime {
  double begin = 0.0, end = 0.0;  ///< s
  double first = 0.0;             ///< the first instant that is asked for, not before `begin` [s]
  std::string by;                 ///< "the run (12 steps of 0.1 s)"
};

/// Of a whole run from its start, which in statics is one instant.
AskedTime asked_by_run(const Case& c);
/// Of the fixed point of the section `prestress`: the instant of the loads on the wall. Throws when there is none.
AskedTime asked_by_prestress(const Case& c);

/// Every table that is not periodic and does not hold all of that time, named by its place in the case (boundary.<face>
/// or boundary.<pattern>), with the end of both; and those that do not read.
std::vector<Problem> check_table_ends(const std::vector<std::pair<std::string, bc::Condition>>& conditions,
                                      const AskedTime& asked);

/// The conditions whose name or pattern fits one of the faces.
std::vector<std::pair<std::string, bc::Condition>> conditions_on(
    const std::vector<std::pair<std::string, bc::Condition>>& conditions, const std::vector<std::string>& faces);

}  // namespace tunica::case_file
