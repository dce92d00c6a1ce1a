#include "tunica/stages/run/simulation.hpp"

#include "tunica/base/error.hpp"
#include "tunica/stages/run/run_in_steps.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

std::size_t Run::find_outlet(const std::string& face) const {
  std::string names;
  for (std::size_t k = 0; k < state_.outlets.size(); ++k) {
    if (state_.outlets[k].face() == face) return k;
    names += (k == 0 ? "" : ", ") + state_.outlets[k].face();
  }
  throw InputError("outlet " + face, "the case has no resistance and no Windkessel on a face of this name",
                   names.empty() ? "give a face the condition `rcr` or `resistance`" : "name one of: " + names);
}

const OutletModel& Run::outlet(const std::string& face) const { return outlet_models_[find_outlet(face)]; }

void Run::set_outlet(const std::string& face, const OutletModel& model) {
  refuse_after_end();
  const std::size_t k = find_outlet(face);
  const bool resistances = std::holds_alternative<bc::Resistance>(model);
  if (model.index() != outlet_models_[k].index())
    throw InputError("outlet " + face,
                     resistances ? "is a Windkessel, and is given the parameters of a resistance"
                                 : "is a resistance, and is given the parameters of a Windkessel",
                     "keep the kind of outlet that the case has");
  bc::Outlet changed(face, model);
  if (resistances)
    changed.set_initial_flow(state_.outlets[k].flow());  // it stores nothing
  else
    changed.restore(state_.outlets[k].state());
  state_.outlets[k] = std::move(changed);
  outlet_models_[k] = model;
  const auto* rcr = std::get_if<bc::Rcr>(&model);
  const auto* resistance = std::get_if<bc::Resistance>(&model);
  log_->info(fmt::format(
      "from t = {} on, outlet {}: {}", time_text(grid_.time()), face,
      rcr ? fmt::format("proximal {:.6g} Pa s/m^3, capacitance {:.6g} m^3/Pa, distal {:.6g} Pa s/m^3, distal pressure "
                        "{:.6g} Pa",
                        rcr->proximal, rcr->capacitance, rcr->distal, rcr->distal_pressure)
          : fmt::format("resistance {:.6g} Pa s/m^3, distal pressure {:.6g} Pa", resistance->resistance,
                        resistance->distal_pressure)));
}

Simulation::Simulation(const ReadCase& c, const RunRequest& request, MPI_Comm comm, std::FILE* screen)
    : run_(std::make_unique<Run>(c, request, comm, screen)) {}
Simulation::~Simulation() = default;
bool Simulation::step() { return run_->step(); }
RunOutcome Simulation::finish() { return run_->finish(); }
fs::path Simulation::checkpoint() { return run_->checkpoint(); }
bool Simulation::finished() const { return run_->ended(); }
std::int64_t Simulation::steps() const { return run_->steps(); }
std::int64_t Simulation::steps_asked() const { return run_->end_step(); }
double Simulation::time() const { return run_->time(); }
const artifacts::StepHistory& Simulation::last() const { return run_->last(); }
const coupling::State& Simulation::state() const { return run_->state(); }
const distributed::DistributedMesh& Simulation::mesh() const { return run_->mesh(); }
quantities::Table Simulation::quantity(const std::string& key, const std::string& region) {
  return run_->quantity(key, region);
}
fs::path Simulation::folder() const { return run_->folder(); }
OutletModel Simulation::outlet(const std::string& face) const { return run_->outlet(face); }
void Simulation::set_outlet(const std::string& face, const OutletModel& model) { run_->set_outlet(face, model); }

}  // namespace tunica::stages
