#include "tunica/pipeline/what_if.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/patience.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/scan_anatomy.hpp"
#include "tunica/pipeline/what_if_page.hpp"
#include "tunica/pipeline/what_if_plan.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
constexpr double section_spacing = 4e-3;  ///< m

/// Whether lumen and wall meet in the mesh of the case, and by which faces.
struct Between {
  std::string lumen, wall;
};
Between faces_between(const Chain& chain) {
  if (const auto meshes = meshes_of(chain); meshes.interface)
    return {meshes.interface->lumen_faces.front(), meshes.interface->wall_faces.front()};
  const auto run = case_file::describe(chain.settings);
  return {run.sticking_faces.empty() ? meshing::lumen_interface : run.sticking_faces.front(), ""};
}

class WhatIfRun {
 public:
  WhatIfRun(const WhatIfRequest& request, MPI_Comm comm, std::FILE* screen)
      : request_(request), comm_(comm), screen_(screen) {}

  int all() {
    begin();
    if (const int signal = chain(case_file_, "the case itself"); signal != 0) return signal;
    make_cases();
    for (std::size_t k = 0; k < files_.size(); ++k)
      if (const int signal = chain(files_[k], names_[k]); signal != 0) return signal;
    parallel::on_root(comm_, [&] {
      say("");
      say(write_what_if(plan_, *chain_, remarks_));
    });
    return 0;
  }

 private:
  void begin() {
    parallel::on_root_patiently(comm_, [&] {
      plan_ = plan_what_if(request_.file, request_.output);
      case_file_ = plan_.case_file.string();
      files::make_folder(plan_.output);
      files::try_outputs(plan_.output, {"what_if.csv", "what_if.html"});
      lock_ = files::FolderLock(plan_.output);
      if (!lock_.taken_over().empty()) say("warning: " + lock_.taken_over());
      for (const auto& [name, variant] : plan_.settings.variants) {
        names_.push_back(name);
        changes_mesh_ = changes_mesh_ || variant.changes_mesh() ? 1 : 0;
      }
    });
    parallel::broadcast(comm_, case_file_);
    parallel::broadcast(comm_, names_);
    parallel::broadcast(comm_, changes_mesh_);
  }

  int chain(const std::string& file, const std::string& name) {
    parallel::on_root(comm_, [&] { say(fmt::format("\n##### {}", name)); });
    ChainRequest request;
    request.case_file = file;
    request.program = request_.program;
    return run_chain(request, comm_, screen_);
  }

  /// Meshes and case files of all variants, on what the case has made.
  void make_cases() {
    std::vector<Problem> warnings;
    chain_.emplace(parallel::agree(comm_, [&] { return read_chain(case_file_, std::nullopt, warnings); }));
    std::optional<ScanAnatomy> scan;
    if (changes_mesh_ != 0) scan = scan_anatomy(*chain_, section_spacing, comm_);
    parallel::on_root(comm_, [&] {
      if (scan) name_tears_as_post(*scan);
      for (std::size_t k = 0; k < names_.size(); ++k) {
        const fs::path folder = plan_.folder_of(k), file = folder / "case.yaml";
        files::make_folder(folder);
        if (plan_.settings.variants[k].second.changes_mesh()) make_mesh(k, *scan);
        const std::string text = variant_text(plan_, k, *chain_, scan ? scan->end : "");
        if (!files::holds(file, text)) files::write_atomically(file, text);
        files_.push_back(file.string());
      }
    });
    parallel::broadcast(comm_, files_);
  }

  /// Names are those that the user reads in the results of the case.
  void name_tears_as_post(ScanAnatomy& scan) const {
    const auto post = read_json(folder_of(*chain_, stage("post")) / "post.json");
    for (auto& tear : scan.anatomy.tears) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& known : post.value("tears", nlohmann::json::array())) {
        const auto& c = known.at("centre_mm");
        const Vec3<double> centre{{c[0].get<double>(), c[1].get<double>(), c[2].get<double>()}};
        if (const double d = norm(geometry::mm * centre - tear.centre); d < nearest) {
          nearest = d;
          tear.name = known.at("name").get<std::string>();
        }
      }
    }
  }

  void make_mesh(std::size_t k, const ScanAnatomy& scan) {
    const auto between = faces_between(*chain_);
    analysis::ChangedMesh changed;
    try {
      changed = analysis::change_anatomy(scan.data, scan.anatomy, change_of(plan_.settings.variants[k].second, *chain_),
                                         between.lumen, between.wall);
    } catch (const InputError& error) {
      std::vector<Problem> problems;
      for (const auto& p : error.problems())
        problems.push_back({fmt::format("variants.{}: {}", names_[k], p.where), p.what, p.remedy});
      throw InputError(std::move(problems));
    }
    for (const auto& remark : changed.remarks) say(fmt::format("{}: {}", names_[k], remark));
    remarks_[names_[k]] = changed.remarks;
    const fs::path folder = plan_.folder_of(k) / "mesh";
    mesh_io::write_simvascular(folder / "lumen", changed.data, mesh::RegionKind::lumen, geometry::mm);
    std::vector<std::string> regions;
    std::optional<case_file::InterfaceSettings> interface;
    if (!between.wall.empty()) {
      regions = mesh_io::write_simvascular(folder / "wall", changed.data, mesh::RegionKind::wall, geometry::mm);
      interface = case_file::InterfaceSettings{{between.lumen}, {between.wall}};
    }
    const std::string section = regions.empty() ? "meshes:\n  length_unit: mm\n  lumen: {simvascular: lumen}\n"
                                                : artifacts::meshes_section(regions, interface);
    files::write_atomically(folder / "meshes.yaml", section);
  }

  void say(const std::string& line) const {
    std::fprintf(screen_, "%s\n", line.c_str());
    std::fflush(screen_);
  }

  const WhatIfRequest& request_;
  MPI_Comm comm_;
  std::FILE* screen_;
  std::string case_file_;  ///< on all ranks, as the next three
  std::vector<std::string> names_, files_;
  int changes_mesh_ = 0;
  std::optional<Chain> chain_;

  WhatIfPlan plan_;  ///< rank 0, as the next two
  std::map<std::string, std::vector<std::string>> remarks_;
  files::FolderLock lock_;
};

}  // namespace

int what_if(const WhatIfRequest& request, MPI_Comm comm, std::FILE* screen) {
  return WhatIfRun(request, comm, screen).all();
}

}  // namespace tunica::pipeline
