// What can be said of a whole case before any of its stages is done. `tunica check` and `tunica run` both ask here.
#pragma once

#include <string>
#include <vector>

#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

/// All that is wrong as far as the file and the tables that it names tell: faces and regions of a mesh that is yet to
/// be made are known by the names of its openings, those of `meshes` are not looked at. Not collective, as all here.
std::vector<Problem> foreseen_problems(const Chain& chain);

/// Names of the openings of a mesh that the case has yet to make, the inlet first; empty where nobody names them, or
/// where the case names its meshes. Throws InputError as the tables that they stand in.
std::vector<std::string> openings_to_come(const case_file::Case& c);

/// Reads the meshes of a case that names some, and asks every stage whether it could begin on them; poses the problem
/// of the run with what is not made yet (directions, prestress, tuned outlets) left out. Returns lines on the meshes.
/// Throws InputError with what a stage would throw. Nothing for a case whose mesh is yet to be made.
std::vector<std::string> check_on_meshes(const Chain& chain);

/// The case with one of the laws of `compare` in the place of its own.
config::Document with_law(const config::Document& document, const std::string& name);

}  // namespace tunica::pipeline
