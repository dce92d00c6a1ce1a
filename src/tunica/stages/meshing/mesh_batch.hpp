// Many meshes, or previews, one after the other, and one table of what became of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tunica::stages {

struct MeshOutcome {
  std::string file;
  int exit_code = 0;  ///< 0 done, 2 the input is wrong, 3 a computation failed
  double seconds = 0;
  std::string message;  ///< what was made, or the first problem; one line
};

/// Calls `make(file)`, which returns what it made in a line, for each file, whatever becomes of the others. Errors
/// become outcomes; nothing is thrown.
std::vector<MeshOutcome> attempt_all(const std::vector<std::string>& files,
                                     const std::function<std::string(const std::string&)>& make);

/// For the terminal, with a line that counts them.
std::string outcome_text(const std::vector<MeshOutcome>& outcomes);

/// Writes file, exit_code, seconds and outcome as a table (.csv). InputError when it cannot be written.
void write_outcomes(const std::vector<MeshOutcome>& outcomes, const std::string& path);

/// The largest exit code; 0 without any.
int worst_of(const std::vector<MeshOutcome>& outcomes);

}  // namespace tunica::stages
