#include "tunica/stages/validate/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/config/nearest.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/validate/validation_page.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using validate::Benchmark;
using validate::Finding;
using validate::Variant;

namespace {

std::vector<Benchmark> chosen(const std::vector<std::string>& names) {
  const auto all = validate::benchmarks();
  std::vector<Benchmark> list;
  if (names.empty()) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(list), [](const auto& b) { return !b.long_run; });
    return list;
  }
  std::vector<std::string> known;
  for (const auto& b : all) known.push_back(b.name);
  for (const auto& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& b) { return b.name == name; });
    if (found == all.end()) {
      const auto nearest = config::nearest(name, known);
      throw InputError("validate", fmt::format("there is no benchmark `{}`", name),
                       nearest.empty() ? "see `tunica validate --list`" : fmt::format("did you mean {}?", nearest));
    }
    list.push_back(*found);
  }
  return list;
}

bool has_region(const mesh::MeshData& data, mesh::RegionKind kind) {
  return std::any_of(data.regions.begin(), data.regions.end(), [&](const auto& r) { return r.kind == kind; });
}

/// Does the file say something else, or is it not there? Writes it then.
bool renew(const fs::path& file, const std::string& content) {
  if (fs::exists(file) && text::read(file) == content) return false;
  files::write_atomically(file, content);
  return true;
}

/// Writes case and mesh, which are the same every time; meshes what is to be meshed and has not been. Not collective.
void write_case(const fs::path& folder, const Benchmark& benchmark, const Variant& variant, const MakeMesh& make_mesh) {
  const auto posed = benchmark.pose(variant);
  fs::create_directories(folder);
  if (posed.mesh) {
    if (has_region(*posed.mesh, mesh::RegionKind::lumen))
      mesh_io::write_simvascular(folder / "lumen", *posed.mesh, mesh::RegionKind::lumen, 1.0);
    if (has_region(*posed.mesh, mesh::RegionKind::wall))
      mesh_io::write_simvascular(folder / "wall", *posed.mesh, mesh::RegionKind::wall, 1.0);
  }
  bool renewed = false;
  for (const auto& [name, content] : posed.files) renewed = renew(folder / name, content) || renewed;
  if (fs::exists(folder / "mesh.yaml") && (renewed || !fs::exists(folder / "mesh" / "meshes.yaml"))) {
    fs::remove(folder / "mesh" / "meshes.yaml");  // so that a mesh of files that were cut off is not taken for theirs
    make_mesh(folder / "mesh.yaml");
  }
  files::write_atomically(folder / "case.yaml", posed.case_text);
}

/// What is to be done with results that are there. Not collective.
enum class Earlier { none, finished, interrupted, other };
Earlier earlier_results(const ReadCase& c) {
  const auto results = artifacts::find_results(c.settings.output.directory);
  if (!results) return Earlier::none;
  const bool same = results->damage.empty() && results->case_hash == c.inputs.fingerprint() &&
                    results->mesh_hash == artifacts::mesh_hash(c.mesh.data);
  if (!same) return Earlier::other;
  if (results->status == "completed") return Earlier::finished;
  return results->last_step > 0 ? Earlier::interrupted : Earlier::other;
}

class Validation {
 public:
  Validation(MPI_Comm comm, const ValidateRequest& request, std::FILE* screen)
      : comm_(comm), request_(request), screen_(screen), variant_{request.full, request.elements} {}

  ValidateOutcome compute(const std::vector<Benchmark>& list) {
    ValidateOutcome outcome;
    std::vector<Finding> findings;
    for (const auto& benchmark : list) {
      Finding finding{.benchmark = benchmark, .variant = variant_};
      outcome.signal = compute(finding);
      findings.push_back(std::move(finding));
      parallel::on_root(comm_, [&] { validate::write_page(request_.folder, findings); });
      if (outcome.signal != 0) return outcome;
    }
    outcome.passed = parallel::on_root(
        comm_, [&] { return std::all_of(findings.begin(), findings.end(), [](const auto& f) { return f.passed(); }); });
    parallel::broadcast(comm_, outcome.passed);
    return outcome;
  }

 private:
  void say(const std::string& line) const {
    if (parallel::rank(comm_) != 0 || screen_ == nullptr) return;
    std::fprintf(screen_, "%s\n", line.c_str());
    std::fflush(screen_);
  }

  int compute(Finding& finding) {
    const auto& benchmark = finding.benchmark;
    const fs::path folder = request_.folder / benchmark.name;
    say(fmt::format("{}: {}", benchmark.name, benchmark.title));
    parallel::on_root(comm_, [&] { write_case(folder, benchmark, variant_, request_.make_mesh); });
    const auto started = std::chrono::steady_clock::now();
    int signal = 0;
    try {
      signal = run(folder, finding);
    } catch (const SolverError& error) {  // thrown on all ranks alike
      finding.failure = error.what();
      say(fmt::format("  failed: {}", error.what()));
      return 0;
    }
    finding.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    if (signal != 0) {
      finding.failure = "stopped by a signal";
      return signal;
    }
    parallel::on_root(comm_, [&] {
      const validate::Results results(folder / "results");
      finding.values = benchmark.measure(results);
      if (benchmark.plot) finding.plot = benchmark.plot(results);
    });
    for (std::size_t k = 0; k < finding.values.size(); ++k) say("  " + validate::line(finding, k));
    return 0;
  }

  int run(const fs::path& folder, Finding& finding) {
    const ReadCase c = read_case(comm_, folder / "case.yaml");
    auto earlier = parallel::on_root(comm_, [&] { return earlier_results(c); });
    parallel::broadcast(comm_, earlier);
    finding.reused = earlier == Earlier::finished;
    parallel::on_root(comm_, [&] {
      finding.nodes = std::ssize(c.mesh.data.points);
      finding.elements = std::ssize(c.mesh.data.tetrahedra);
      finding.steps = c.settings.time ? c.settings.time->steps : 1;
      finding.step = c.settings.time ? c.settings.time->step : 0;
    });
    if (finding.reused) return 0;
    RunRequest request;
    request.case_file = folder / "case.yaml";
    request.restart = earlier == Earlier::interrupted;
    request.overwrite = earlier == Earlier::other;
    request.resume = fmt::format("tunica validate {}{} -o {}", finding.benchmark.name, request_.full ? " --full" : "",
                                 request_.folder.string());
    request.program = request_.program;
    return request_.run_case(c, request, comm_, nullptr).signal;
  }

  MPI_Comm comm_;
  const ValidateRequest& request_;
  std::FILE* screen_;
  Variant variant_;
};

}  // namespace

std::string list_benchmarks() {
  std::string text;
  for (const auto& b : validate::benchmarks())
    text += fmt::format("{:18} {}{}\n", b.name, b.title, b.long_run ? " (done only when it is named)" : "");
  return text;
}

ValidateOutcome validate_program(MPI_Comm comm, const ValidateRequest& request, std::FILE* screen) {
  const auto list = chosen(request.names);  // the same on all ranks
  const auto lock = parallel::on_root(comm, [&] {
    fs::create_directories(request.folder);
    return std::make_shared<files::FolderLock>(request.folder);
  });
  return Validation(comm, request, screen).compute(list);
}

}  // namespace tunica::stages
