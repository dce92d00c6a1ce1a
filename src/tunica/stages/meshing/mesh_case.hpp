// `tunica mesh`: from what its file says to a mesh and a report on it.
#pragma once

#include <functional>
#include <string>

#include "tunica/case/mesh_settings.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::stages {

struct MadeMesh {
  mesh::MeshData data;
  std::string report_json, report_text;  ///< see mesh_report.hpp
  std::string report_page;               ///< see mesh_page.hpp
  std::string summary;                   ///< one line: how many elements, which tears
};

/// What the terminal says of a mesh that was written.
struct WrittenMesh {
  std::string text, summary;
};

/// Throws SolverError when the mesh does not become what it has to be.
MadeMesh make_mesh(const case_file::MeshCase& mesh_case, const files::Say& say);

/// Makes the mesh and writes lumen/ and wall/ (SimVascular's layout, mm), report.json, report.html and meshes.yaml, the
/// section for a case file. Returns the report as text and in a line. Throws InputError when there is a mesh already
/// and `overwrite` is false. `before_work`: called once that is settled.
WrittenMesh mesh_to_files(
    const case_file::MeshCase& mesh_case, bool overwrite, const files::Say& say,
    const std::function<void()>& before_work = [] {});

}  // namespace tunica::stages
