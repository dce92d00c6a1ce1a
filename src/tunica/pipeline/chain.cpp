#include "tunica/pipeline/chain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/patience.hpp"
#include "tunica/pipeline/compare.hpp"
#include "tunica/pipeline/foresight.hpp"
#include "tunica/pipeline/plan.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;

/// Number of the wanted stage with this name. Throws InputError when there is none.
std::size_t place_of(const std::vector<const Stage*>& wanted, const std::string& name, const char* option) {
  const auto at = std::find_if(wanted.begin(), wanted.end(), [&](const Stage* s) { return s->name == name; });
  if (at != wanted.end()) return static_cast<std::size_t>(at - wanted.begin());
  std::vector<std::string> names;
  for (const auto* stage : wanted) names.emplace_back(stage->name);
  throw InputError(option, fmt::format("`{}` is no stage of this case", name),
                   "its stages: " + mesh::list_names(names));
}

/// Number of the first stage that is done in any case.
std::size_t first_anew(const ChainRequest& request, const std::vector<const Stage*>& wanted) {
  if (request.overwrite) return 0;
  return request.from ? place_of(wanted, *request.from, "--from") : wanted.size();
}

/// First lines of a stage's case file. No absolute path: the folder may be moved.
std::string head_of(const Chain& chain, const Stage& stage) {
  const fs::path folder = absolute_path(folder_of(chain, stage));
  return fmt::format(
      "# {}: made by `tunica run` from {}, and written anew by the next one.\n"
      "# By hand, in this folder: {}\n",
      stage.what, absolute_path(chain.file).lexically_relative(folder).string(), stage.by_hand);
}

void remove_partial(const fs::path& folder, const Stage& stage) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    for (const auto& pattern : stage.partial)
      if (case_file::matches(pattern, entry.path().filename().string())) found.push_back(entry.path());
  for (const auto& path : found) fs::remove_all(path);
}

/// What all ranks know of the stage to come.
struct Decision {
  bool fresh = false, resume = false;
};

/// One `tunica run` of a chain. Its member functions are collective; chain and plan are those of rank 0.
class ChainRun {
 public:
  ChainRun(const ChainRequest& request, MPI_Comm comm, std::FILE* screen)
      : request_(request), comm_(comm), screen_(screen) {}

  int steps() {
    begin();
    for (std::size_t k = 0; k < count_; ++k)
      if (const int signal = one(k); signal != 0) return signal;
    say(table());
    return 0;
  }

 private:
  struct Line {
    std::string stage, state;
    double seconds;
  };

  void begin() {
    parallel::on_root(comm_, [&] {
      std::vector<Problem> warnings;
      chain_ = read_chain(request_.case_file, request_.directory, warnings);
      chain_.program = request_.program;
      for (const auto& warning : warnings) say("warning: " + format(warning));
      take_folder(lock_, chain_.output);
    });
    parallel::on_root_patiently(comm_, [&] {
      if (request_.only)
        choose_only(*request_.only);
      else
        choose();
    });
    parallel::broadcast(comm_, count_);
    parallel::broadcast(comm_, places_);
  }

  int one(std::size_t k) {
    const Stage& stage = stages()[places_[k]];
    Decision decision = parallel::on_root(comm_, [&] { return decide(k, stage); });
    parallel::broadcast(comm_, decision);
    if (decision.fresh) return 0;
    std::string file = parallel::on_root(comm_, [&] { return prepare(stage); });
    parallel::broadcast(comm_, file);
    const double start = MPI_Wtime();
    try {
      const int signal = stage.run({.comm = comm_,
                                    .file = file,
                                    .resume = decision.resume,
                                    .program = request_.program,
                                    .screen = screen_,
                                    .verbose = request_.verbose});
      parallel::on_root(comm_, [&] {
        if (signal == 0) record_.outputs = outputs_of(folder_, stage.outputs);
        end(signal == 0 ? "done" : "stopped", "", MPI_Wtime() - start);
      });
      return signal;
    } catch (const InputError& error) {
      record_failure(error.what(), MPI_Wtime() - start);
      auto problems = error.problems();
      for (auto& p : problems) p.where = fmt::format("stage {}: {}", stage.name, p.where);
      throw InputError(std::move(problems));
    } catch (const SolverError& error) {
      record_failure(error.what(), MPI_Wtime() - start);
      throw SolverError(fmt::format(
          "stage {} ({} of {}) failed: {}\n  the stages before it are kept, and so is what it "
          "has written to {}; to go on: tunica run {}",
          stage.name, k + 1, count_, error.what(), fs::path(file).parent_path().string(), request_.case_file.string()));
    } catch (const std::exception& error) {
      record_failure(error.what(), MPI_Wtime() - start);
      throw;
    } catch (...) {
      record_failure("unknown error", MPI_Wtime() - start);
      throw;
    }
  }

  // --- rank 0 -------------------------------------------------------------------------------------------------------

  void add(const Stage& stage) { places_.push_back(static_cast<std::size_t>(&stage - stages().data())); }

  void choose() {
    const auto wanted = wanted_stages(chain_);
    count_ = request_.until ? place_of(wanted, *request_.until, "--until") + 1 : wanted.size();
    // Now, not after the hours of the stages before it.
    for (std::size_t k = 0; k < count_; ++k) files::refuse_if_owned_by_another(folder_of(chain_, *wanted[k]));
    from_ = first_anew(request_, wanted);
    for (const auto* stage : wanted) add(*stage);
    // What a stage would refuse is told before any is done. Figures and page look at what they need themselves.
    for (std::size_t k = 0; k < count_ && comes_before_results(*wanted[k]); ++k)
      if (!plan(chain_, *wanted[k], k >= from_).fresh) {
        check_on_meshes(chain_);
        break;
      }
  }

  static bool comes_before_results(const Stage& stage) {
    return stage.name != std::string("post") && stage.name != std::string("report");
  }

  /// One stage, whether the case has its section or not.
  void choose_only(const std::string& name) {
    if (!chain_.document.has(name)) chain_.document.set(name, config::Document("{}"));
    count_ = 1;
    from_ = request_.overwrite ? 0 : 1;
    for (const auto& stage : stages()) {
      if (stage.name == name) return add(stage);
      const fs::path result = folder_of(chain_, stage) / stage.result;
      if (stage.wanted(chain_.settings) && !fs::exists(result))
        throw InputError(result.string(), fmt::format("is missing: the stage {} comes before {}", stage.name, name),
                         fmt::format("do it first: tunica run {} --until {}", request_.case_file.string(), stage.name));
      if (!stage.wanted(chain_.settings)) continue;
      if (const Plan before = plan(chain_, stage, false); !before.fresh)
        say(fmt::format("warning: what the stage {} has left does not belong to the case as it is now: {}", stage.name,
                        before.reason));
    }
  }

  void say(const std::string& text) const {
    if (parallel::rank(comm_) != 0 || !screen_) return;
    std::fprintf(screen_, "%s\n", text.c_str());
    std::fflush(screen_);
  }

  void take_folder(files::FolderLock& lock, const fs::path& folder) const {
    lock = files::FolderLock(folder);
    if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
  }

  Decision decide(std::size_t k, const Stage& stage) {
    files::refuse_if_owned_by_another(folder_of(chain_, stage));
    plan_ = plan(chain_, stage, k >= from_);
    const auto state = plan_.fresh ? fmt::format("reused from {}", plan_.last->time) : plan_.reason;
    say(fmt::format("{}=== stage {}/{}: {} ({}): {}", k == 0 ? "" : "\n", k + 1, count_, stage.name, stage.what,
                    state));
    if (plan_.fresh) lines_.push_back({stage.name, "reused", plan_.last->seconds});
    return {plan_.fresh, plan_.resume};
  }

  std::string prepare(const Stage& stage) {
    const fs::path folder = folder_of(chain_, stage), file = folder / stage.file;
    take_folder(stage_lock_, folder);
    files::try_outputs(folder, {stage.file, stage.result, "stage.json"});
    if (!plan_.resume) remove_partial(folder, stage);
    files::write_atomically(file, head_of(chain_, stage) + config::commented_yaml(plan_.document, *stage.description));
    record_ = {.stage = stage.name,
               .status = "running",
               .message = "",
               .inputs = plan_.inputs,
               .outputs = {},
               .seconds = plan_.resume ? plan_.last->seconds : 0,
               .ranks = parallel::size(comm_),
               .version = request_.program.version,
               .commit = request_.program.commit,
               .time = ""};
    folder_ = folder;
    write_record(folder, record_);
    return file.string();
  }

  void end(const std::string& status, const std::string& message, double seconds) {
    record_.status = status;
    record_.message = message;
    record_.seconds += seconds;
    write_record(folder_, record_);
    lines_.push_back({record_.stage, status, record_.seconds});
    stage_lock_ = {};
  }

  /// The error that is on its way is what counts, whether it can be recorded or not.
  void record_failure(const std::string& message, double seconds) {
    if (parallel::rank(comm_) != 0) return;
    try {
      end("failed", message, seconds);
    } catch (const SolverError& error) {
      say(fmt::format("warning: the failure of the stage is not recorded: {}", error.what()));
    }
  }

  std::string table() const {
    std::string text = fmt::format("\n{:<12}{:<10}{:>10}\n", "stage", "", "seconds");
    for (const auto& line : lines_)
      text += fmt::format("{:<12}{:<10}{:>10.1f}\n", line.stage, line.state, line.seconds);
    return text + "results in " + chain_.output.string();
  }

  const ChainRequest& request_;
  MPI_Comm comm_;
  std::FILE* screen_;
  std::size_t count_ = 0;            ///< stages that are looked at
  std::vector<std::size_t> places_;  ///< of the wanted stages in stages()

  files::FolderLock lock_;        ///< of the folder of results; rank 0, as what follows
  files::FolderLock stage_lock_;  ///< of the stage that is being done, which finds it its own
  Chain chain_;
  std::size_t from_ = 0;  ///< first stage that is done in any case
  Plan plan_;
  Record record_;
  fs::path folder_;
  std::vector<Line> lines_;
};

/// The outlets are given where they have a file, named or beside the case, and nothing else is to be done.
bool asks_for_stages(const config::Document& d, const fs::path& folder) {
  for (const char* section : {"mesh", "fibres", "post", "report", "compare"})
    if (d.has(section)) return true;
  if (d.has("prestress") && !d.has("wall.prestress")) return true;
  if (!d.has("outlets") || d.has("outlets.file")) return false;
  const std::string given = d.text("outlets.output");
  return !fs::exists(folder / (given.empty() ? "outlets" : given) / "outlets.yaml");
}

}  // namespace

bool is_chain(const fs::path& case_file, MPI_Comm comm) {
  bool chain = parallel::on_root(comm, [&] {
    return asks_for_stages(config::Document(config::read_text(case_file), case_file.string()), case_file.parent_path());
  });
  parallel::broadcast(comm, chain);
  return chain;
}

bool lies_in_stages(const fs::path& case_file, MPI_Comm comm) {
  if (!is_chain(case_file, comm)) return false;
  bool apart = parallel::on_root(comm, [&] {
    const config::Document document(config::read_text(case_file), case_file.string());
    const std::string given = document.text("output.directory");
    const fs::path results = case_file.parent_path() / (given.empty() ? "results" : given);
    return !document.has("meshes") || !fs::exists(results / "manifest.json");
  });
  parallel::broadcast(comm, apart);
  return apart;
}

bool is_case(const fs::path& file, MPI_Comm comm) {
  bool found =
      parallel::on_root(comm, [&] { return config::Document(config::read_text(file), file.string()).has("analysis"); });
  parallel::broadcast(comm, found);
  return found;
}

OwnRecord::OwnRecord(const std::string& name, const fs::path& file, const fs::path& folder, int ranks,
                     const artifacts::ProgramVersion& program)
    : folder_(folder) {
  const Stage& of_name = stage(name);
  const config::Document document(config::read_text(file), file.string());
  const config::Origin origin{.name = file.string(), .folder = file.parent_path()};
  record_.stage = name;
  record_.inputs = artifacts::inputs_of(of_name.settings(document, origin), of_name.without);
  record_.ranks = ranks;
  record_.version = program.version;
  record_.commit = program.commit;
}

void OwnRecord::begin() {
  files::make_folder(folder_);
  record_.status = "running";
  write_record(folder_, record_);
}

void OwnRecord::done() {
  record_.status = "done";
  record_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  write_record(folder_, record_);
}

std::vector<std::string> check_chain(const ChainRequest& request, bool with_meshes) {
  std::vector<Problem> warnings;
  const Chain chain = read_chain(request.case_file, request.directory, warnings);
  std::vector<std::string> lines;
  for (const auto& warning : warnings) lines.push_back("warning: " + format(warning));
  if (with_meshes)
    for (const auto& line : check_on_meshes(chain)) lines.push_back(line);
  const auto wanted = wanted_stages(chain);
  const auto end = request.until ? place_of(wanted, *request.until, "--until") + 1 : wanted.size();
  const auto from = first_anew(request, wanted);
  std::string earlier;  // the first stage that will be done: those after it read its result
  for (std::size_t k = 0; k < end; ++k) {
    const Stage& stage = *wanted[k];
    std::string state = "would be done: ";
    if (!earlier.empty()) {
      state += earlier + " comes before it";
    } else {
      const Plan p = plan(chain, stage, k >= from);
      if (p.fresh)
        state = fmt::format("fresh, of {}{}", p.last->time,
                            p.last->version == request.program.version ? "" : ", by version " + p.last->version);
      else
        state += p.reason, earlier = stage.name;
    }
    lines.push_back(fmt::format("{}/{} {:<10} {}", k + 1, end, stage.name, state));
  }
  if (!chain.settings.compare.empty() && !request.until)
    lines.push_back(fmt::format("then {} laws side by side, each with stages of its own in {}",
                                chain.settings.compare.size(), (chain.output / "compare").string()));
  return lines;
}

int run_chain(const ChainRequest& request, MPI_Comm comm, std::FILE* screen) {
  if (request.dry_run) {
    parallel::on_root(comm, [&] {
      for (const auto& line : check_chain(request, false)) std::fprintf(screen, "%s\n", line.c_str());
    });
    return 0;
  }
  if (const int signal = ChainRun(request, comm, screen).steps(); signal != 0) return signal;
  bool compares = parallel::on_root(comm, [&] {
    return !request.until && !request.only &&
           config::Document(config::read_text(request.case_file), request.case_file.string()).has("compare");
  });
  parallel::broadcast(comm, compares);
  return compares ? compare_on_common(request, comm, screen) : 0;
}

}  // namespace tunica::pipeline
