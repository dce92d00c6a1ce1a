// Files that one stage leaves for another: checkpoints, prestress, tuned outlets, histories, the manifest.
#include <optional>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include "fuzz/target.hpp"
#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/artifacts/prestress_file.hpp"
#include "tunica/config/description.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/petsc.hpp"
#include "tunica/wall/quadratic_element.hpp"

namespace tunica::fuzz {

namespace fs = std::filesystem;

const char* const target_name = "artifacts";

namespace {

/// MPI loses memory of its own as it starts and as it ends. Only what it allocates then is not watched.
class UnwatchedSession {
 public:
  UnwatchedSession() {
    unwatched([&] { session_.emplace(); });
  }
  ~UnwatchedSession() {
    unwatched([&] { session_.reset(); });
  }
  UnwatchedSession(const UnwatchedSession&) = delete;
  UnwatchedSession& operator=(const UnwatchedSession&) = delete;

 private:
  template <class Action>
  static void unwatched(const Action& action) {
#ifdef __SANITIZE_ADDRESS__
    const __lsan::ScopedDisabler disabled;
#endif
    action();
  }

  std::optional<parallel::Session> session_;
};

/// A cube of six elements, in this process alone.
struct Context {
  UnwatchedSession session;
  mesh::MeshData wall = mesh_io::read_simvascular("sv", mesh::RegionKind::wall, "wall", {.metres_per_unit = 1}).data;
  distributed::DistributedMesh mesh = distributed::distribute(wall, MPI_COMM_SELF);
  coupling::State start;
  case_file::TuningCase outlets;
};

Context& context() {
  static Context all;
  return all;
}

}  // namespace

void start_target() {
  auto& c = context();
  for (auto* field :
       {&c.start.velocity_pressure, &c.start.acceleration, &c.start.displacement, &c.start.displacement_rate})
    field->assign(4 * c.mesh.points.size(), 0.0);
  c.outlets.systolic = 16000;
  c.outlets.diastolic = 10000;
  c.outlets.fractions = {{"left", 0.4}, {"right", 0.6}};
  c.start.outlets.emplace_back("outlet", bc::Rcr{.proximal = 1, .capacitance = 2, .distal = 3});
}

void read_one(const fs::path& file, const std::string& kind) {
  auto& c = context();
  if (kind == "checkpoint") {
    artifacts::read_checkpoint(file, c.mesh, c.start, 42, "remove it");
  } else if (kind == "start") {
    auto state = c.start;
    artifacts::read_start(file, c.mesh, state, 42, "remove it");
  } else if (kind == "prestress" || kind == "prestress_quadratic") {
    auto data = c.wall;
    artifacts::read_prestress(file, data, kind == "prestress" ? 1 : wall::quadratic::points);
  } else if (kind == "outlets") {
    artifacts::parse_outlets(config::read_text(file), file, c.outlets);
  } else if (kind == "history") {
    artifacts::CsvTable(file, {"time [s]", "flow [ml/s]"}, 2);
  } else {
    const auto folder = file.parent_path();
    fs::copy_file(file, folder / "manifest.json", fs::copy_options::overwrite_existing);
    artifacts::find_results(folder);
    artifacts::Manifest(folder, {}, true).write({});
  }
}

}  // namespace tunica::fuzz
