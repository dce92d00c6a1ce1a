#include "tunica/stages/post/post.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/progress.hpp"
#include "tunica/stages/post/measured.hpp"
#include "tunica/stages/post/report_files.hpp"
#include "tunica/stages/post/report_json.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::stages::post {

namespace {

namespace fs = std::filesystem;
constexpr const char* post_report_file = "post.json";

/// Without the section `post` those of its schema; a case that computes cycles says how long one is.
analysis::PostSettings settings_of(const case_file::Case& c) {
  analysis::PostSettings settings = post_settings(c);
  if (!settings.period && !settings.from && c.time && c.time->cycles) settings.period = c.time->cycles->period;
  return settings;
}

void check_analysis(const case_file::Case& c) {
  if (std::holds_alternative<case_file::StaticWall>(c.analysis))
    throw InputError("analysis", "is static_wall, which has no course in time", "choose fsi, flow or wall");
}

/// Of the fields that a run in nominal steps writes [s]: the first, every so many, the last.
std::vector<double> times_to_come(const case_file::Case& c) {
  std::vector<double> times;
  const std::int64_t last = c.time->most_steps();
  for (std::int64_t step = 0; step < last; step += c.output.every)
    times.push_back(static_cast<double>(step) * c.time->step);
  times.push_back(static_cast<double>(last) * c.time->step);
  return times;
}

/// Frames as they are needed one after the other: the present one, and its neighbours for rates.
class FrameWindow {
 public:
  FrameWindow(analysis::FieldSeries& series, bool moves) : series_(series), moves_(moves) {}

  const analysis::FieldFrame& at(std::size_t frame) {
    std::erase_if(held_, [&](const auto& held) { return held.first + 2 < frame; });
    const auto found = held_.find(frame);
    return found != held_.end() ? found->second : held_.emplace(frame, series_.read(frame)).first->second;
  }

  /// Of the nodes, from three frames; empty where nothing moves.
  std::vector<double> mesh_velocity(std::size_t frame) {
    if (!moves_) return {};
    const auto d = analysis::derivative_at(series_.times(), frame);
    std::vector<double> velocity(at(frame).displacement.size(), 0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& u = at(d.first + i).displacement;
      for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] += d.weights[i] * u[n];
    }
    return velocity;
  }

 private:
  analysis::FieldSeries& series_;
  bool moves_;
  std::map<std::size_t, analysis::FieldFrame> held_;
};

/// One `tunica post`. Its member functions are collective.
class Post {
 public:
  Post(MPI_Comm comm, const PostRequest& request, std::FILE* screen);
  void steps();

 private:
  void read();
  void prepare_folder();
  void read_lumens();
  void look_at_frames();
  void write();

  MPI_Comm comm_;
  const PostRequest& request_;
  std::FILE* screen_;
  double started_ = MPI_Wtime();
  case_file::Case case_;
  analysis::PostSettings settings_;
  fs::path results_, folder_;
  files::FolderLock lock_;  ///< of folder_, rank 0
  mesh::MeshData data_;
  std::optional<analysis::FieldSeries> series_;
  std::vector<std::string> warnings_;
  std::vector<double> times_;  ///< of the frames in the window [s]
  Window window_;
  std::optional<parallel::Log> log_;
  analysis::Vessel vessel_;
  std::optional<analysis::FrameFigures> frames_;
  std::optional<analysis::FigureTable> figures_;
  analysis::CycleFields fields_;
  MeasuredSections measured_sections_;
  std::optional<artifacts::LumenSeries> run_lumens_;  ///< as the run has written them for the window
};

Post::Post(MPI_Comm comm, const PostRequest& request, std::FILE* screen)
    : comm_(comm), request_(request), screen_(screen) {
  read();
  prepare_folder();
}

void Post::read() {
  std::string text;
  parallel::on_root(comm_, [&] {
    text = request_.case_text ? *request_.case_text : config::read_text(request_.case_file);
    auto parsed = case_file::read_case(text, request_.case_file);
    case_ = std::move(parsed.value);
    for (const auto& warning : parsed.warnings) warnings_.push_back(format(warning));
    check_analysis(case_);
  });
  parallel::broadcast(comm_, text);
  if (parallel::rank(comm_) != 0) case_ = case_file::parse_case(text, request_.case_file);
  settings_ = settings_of(case_);
  results_ = request_.results.value_or(case_.output.directory);
  folder_ = post_folder(case_, request_);
  parallel::agree(comm_,
                  [&] { data_ = artifacts::load_meshes(case_.meshes, case_file::describe(case_).depths()).data; });
  analysis::tell_lumens_apart(case_file::describe(case_), settings_, data_, comm_);
  parallel::agree(comm_, [&] {
    if (case_.elements == case_file::Elements::quadratic) {
      mesh::add_edge_nodes(data_);
      data_ = mesh::subdivided(data_);
    }
    if (case_.measured) measured_sections_ = find_measured_sections(*case_.measured, case_, data_);
    series_.emplace(case_file::describe(case_), data_, results_);
    auto warnings = std::vector<std::string>{};
    window_ = choose_window(series_->times(), settings_, results_.string(), warnings);
    if (parallel::rank(comm_) == 0) warnings_.insert(warnings_.end(), warnings.begin(), warnings.end());
    const auto first = series_->times().begin() + static_cast<std::ptrdiff_t>(window_.first);
    times_.assign(first, first + static_cast<std::ptrdiff_t>(window_.count));
  });
}

void Post::prepare_folder() {
  parallel::on_root(comm_, [&] {
    if (!request_.overwrite && fs::exists(folder_ / post_report_file))
      throw InputError(folder_.string(), "holds figures already", "give --overwrite, or another folder by --output");
    lock_ = files::FolderLock(folder_);
    files::try_outputs(folder_, {post_report_file, "post.log"});
  });
  log_.emplace(comm_, parallel::Log::Targets{.file = folder_ / "post.log", .screen = screen_});
  if (!lock_.taken_over().empty()) log_->warning(lock_.taken_over());
  if (!case_.title.empty()) log_->heading(case_.title);
  for (const auto& line : warnings_) log_->warning(line);
}

// Flows of cuts leave several per cent of the mass of the false lumen unexplained, those of the run none.
void Post::read_lumens() {
  if (vessel_.side.empty()) return;
  std::string warning;
  parallel::agree(comm_, [&] {
    run_lumens_ = post::read_lumens(results_, window_, warning);
    if (!run_lumens_)
      warning +=
          ": flows through the tears and balance of the false lumen are those of cuts, which miss mass by several "
          "per cent; run the case again to have the flows that the scheme conserves";
    else if (!name_as_in_run(run_lumens_->tears, vessel_))
      warning = "the tears of the run are not those of the fields: areas and surfaces of tears have other numbers";
  });
  if (warning.empty()) return;
  warnings_.push_back(warning);
  log_->warning(warning);
}

// Each rank takes a stretch of the window, so that it reads hardly any frame that another one reads as well.
void Post::look_at_frames() {
  const auto ranks = static_cast<std::size_t>(parallel::size(comm_)),
             rank = static_cast<std::size_t>(parallel::rank(comm_));
  const std::size_t begin = times_.size() * rank / ranks, end = times_.size() * (rank + 1) / ranks;
  const auto weights = analysis::trapezoid_weights(times_);
  FrameWindow window(*series_, case_.solves_fluid() && case_.solves_wall());
  const auto start = parallel::agree(comm_, [&] { return series_->read(window_.first).displacement; });
  frames_.emplace(case_file::describe(case_), settings_, data_, vessel_, series_->stresses(), start);
  figures_.emplace(times_.size());
  fields_ = frames_->no_fields();
  parallel::Progress bar(*log_, "post", 0, static_cast<double>(times_.size()) / static_cast<double>(ranks));
  parallel::agree(comm_, [&] {
    for (std::size_t k = begin; k < end; ++k) {
      const auto mesh_velocity = window.mesh_velocity(window_.first + k);
      const auto& frame = window.at(window_.first + k);
      auto row = frames_->evaluate(frame, mesh_velocity);
      add_sections(measured_sections_, frame, mesh_velocity, row);
      figures_->set(k, row);
      frames_->add(frame, weights[k], fields_);
      bar.update(static_cast<double>(k + 1 - begin), fmt::format("field {} of {}", k + 1 - begin, end - begin));
    }
  });
  figures_->gather(comm_);
  analysis::gather(comm_, fields_);
}

void Post::write() {
  parallel::on_root(comm_, [&] {
    Findings findings{.program = request_.program,
                      .case_file = request_.case_file,
                      .results = results_,
                      .title = case_.title,
                      .settings = settings_,
                      .data = data_,
                      .vessel = vessel_,
                      .window = window_,
                      .times = times_,
                      .figures = *figures_,
                      .frames = *frames_,
                      .fields = fields_,
                      .openings = read_openings(results_, case_, vessel_, window_),
                      .left_out = vessel_.left_out,
                      .warnings = warnings_};
    if (case_.solves_fluid())
      findings.dissipation = artifacts::read_dissipation(results_, window_.from, window_.until, case_.elements);
    if (run_lumens_)
      findings.lumens = flows_of_run(*run_lumens_, vessel_, window_.from, window_.until);
    else if (!vessel_.side.empty())
      findings.lumens = flows_of_cuts(*figures_, vessel_, times_);
    const auto too_dissipative = findings.dissipation ? warning_of(*findings.dissipation) : std::nullopt;
    if (too_dissipative) findings.warnings.push_back(*too_dissipative);
    if (!findings.has_flap())
      findings.left_out.push_back({"flap", fmt::format("the wall has no region {}", settings_.flap)});
    if (findings.frames.stresses().empty())
      findings.left_out.push_back({"stress", case_.solves_wall()
                                                 ? "the results have no stress of elements (`output.fields` names none)"
                                                 : "the analysis has no wall"});
    auto report = report_json(findings);
    auto& files = report["files"] = nlohmann::ordered_json::array();
    for (const auto& write : {write_tables, write_plots, write_fields})
      for (const auto& file : write(findings, folder_)) files.push_back(file);
    if (case_.measured) report["measured"] = compare_measured(findings, *case_.measured, folder_, files);
    report["seconds"] = MPI_Wtime() - started_;
    files::write_atomically(folder_ / post_report_file, config::json_text(report));
    log_->info(report_text(report));
    if (case_.measured) log_->info(measured_text(report["measured"]));
    if (too_dissipative) log_->warning(*too_dissipative);
  });
  log_->info(fmt::format("{} files in {}", post_report_file, folder_.string()));
}

void Post::steps() {
  vessel_ = analysis::make_vessel(case_file::describe(case_), settings_, data_, comm_);
  read_lumens();
  look_at_frames();
  write();
}

}  // namespace

void check_post(const case_file::Case& c) {
  check_analysis(c);
  std::vector<std::string> only_of_results;
  choose_window(times_to_come(c), settings_of(c), "post: the run", only_of_results);
}

fs::path post_folder(const case_file::Case& c, const PostRequest& request) {
  if (request.output) return *request.output;
  if (c.post && c.post->output) return *c.post->output;
  return request.results.value_or(c.output.directory) / "post";
}

void post_results(MPI_Comm comm, const PostRequest& request, std::FILE* screen) { Post(comm, request, screen).steps(); }

}  // namespace tunica::stages::post
