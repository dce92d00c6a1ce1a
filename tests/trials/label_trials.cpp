// Trials of the way from a label image to the surface of the lumen: idealised dissections, disturbed in all kinds of
// ways, have to become a surface that is right or an error, and never a wrong surface.
//
//   label_trials [TRIALS [SEED [KIND ...]]]      TRIALS: how many (20), SEED: of the first one (1)
//   label_trials --write FOLDER TRIALS SEED ...  writes images and case files for `run_label_meshes` instead
//   label_trials --keep FILE TRIALS SEED ...     adds each outcome to FILE, and leaves out trials that are in it
//
// A surface is right with as many openings as the body has, the genus of its tears, its volume within 2 % (3 % with
// noise, thick slices and coarse voxels), and a flap whose median thickness is within 0.3 mm, but where the kind
// changes it. Exit code 0: nothing is silently wrong.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "closed_surface.hpp"
#include "disturbed_labels.hpp"
#include "tunica/base/error.hpp"
#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::imaging::trials {
namespace {

using geometry::TriangleSurface;

using test::closed;

double lumen_volume(const geometry::DissectionModel& model) {
  const double h = 0.9e-3;
  const auto box = model.box();
  double count = 0;
  for (double x = box.low[0] + 0.37 * h; x < box.high[0]; x += h)
    for (double y = box.low[1] + 0.61 * h; y < box.high[1]; y += h)
      for (double z = box.low[2] + 0.13 * h; z < box.high[2]; z += h) count += model.at({{x, y, z}}).lumen < 0;
  return count * h * h * h;
}

/// Median over places in the flap of its thickness in the surface less that in the body [m].
double thickness_off(const Body& body, const TriangleSurface& surface) {
  const geometry::TriangleTree tree(closed(surface));
  std::mt19937 random(3);
  const auto box = body.model.box();
  const auto any = [&](int d) { return std::uniform_real_distribution<double>(box.low[d], box.high[d])(random); };
  const double t = body.shape.flap.thickness;
  const auto reach = [&](const Point& start, const Vec3<double>& way, const auto& in_lumen) {
    double low = 0, high = 1.5 * t;
    for (int i = 0; i < 10; ++i) (in_lumen(start + 0.5 * (low + high) * way) ? high : low) = 0.5 * (low + high);
    return low;
  };
  std::vector<double> off;
  while (off.size() < 300) {
    const Point p{{any(0), any(1), any(2)}};
    const auto v = body.model.at(p);
    if (v.flap > -0.3 * t || v.tear < 4e-3 || std::abs(v.side) > 0.3e-3) continue;
    Vec3<double> n;
    for (int d = 0; d < 3; ++d) {
      Point ahead = p, behind = p;
      ahead[d] += 1e-5;
      behind[d] -= 1e-5;
      n[d] = body.model.at(ahead).side - body.model.at(behind).side;
    }
    n = (1 / norm(n)) * n;
    const auto true_one = [&](const Point& x) { return body.model.at(x).lumen < 0; };
    if (body.model.at(p + 1.5 * t * n).lumen > -0.5 * t || body.model.at(p - 1.5 * t * n).lumen > -0.5 * t) continue;
    const auto found = [&](const Point& x) { return tree.contains(x); };
    off.push_back(reach(p, n, found) + reach(p, -1.0 * n, found) - reach(p, n, true_one) -
                  reach(p, -1.0 * n, true_one));
  }
  std::nth_element(off.begin(), off.begin() + 150, off.end());
  return off[150];
}

/// What is wrong with a surface; empty when nothing is.
std::string faults(const Body& body, const std::string& kind, const LabelSurface& made, std::string& figures) {
  std::string result;
  const auto genus = geometry::genus(made.lumen, std::ssize(made.ends));
  if (kind == "named_thrombus") {  // the clot may have closed a tear
    const double clot = geometry::enclosed_volume(closed(*made.with_thrombus)) / lumen_volume(body.model) - 1;
    figures = fmt::format("{} tears, lumen and thrombus {:+.1f} % of the lumen", made.tears.size(), 100 * clot);
    if (genus + 1 != std::ssize(made.tears)) result += fmt::format(" genus {}", genus);
    if (made.ends.size() != body.model.openings().size()) result += fmt::format(" {} openings", made.ends.size());
    return std::abs(clot) > 0.05 ? result + fmt::format(" volume {:+.1f} %", 100 * clot) : result;
  }
  if (genus != 1) result += fmt::format(" genus {}", genus);
  if (made.ends.size() != body.model.openings().size()) result += fmt::format(" {} openings", made.ends.size());
  if (made.tears.size() != 2) result += fmt::format(" {} tears", made.tears.size());
  const double volume = geometry::enclosed_volume(closed(made.lumen)) / lumen_volume(body.model) - 1;
  const double flap = thickness_off(body, made.lumen);
  figures = fmt::format("volume {:+.1f} %, flap {:+.2f} mm", 100 * volume, 1e3 * flap);
  const bool shorter = kind.find("ends") != std::string::npos;  // what was cut off is missing
  const bool other_flap = kind == "thin" || kind == "inserted_flap";
  const double allowed = shorter ? 0.12 : kind == "thin" ? 0.04 : 0.03;
  if (std::abs(volume) > allowed) result += fmt::format(" volume {:+.1f} %", 100 * volume);
  if (!other_flap && std::abs(flap) > 0.3e-3) result += fmt::format(" flap {:+.2f} mm", 1e3 * flap);
  return result;
}

/// With what a mesh of it has to be, in NAME.json.
void write_case(const std::filesystem::path& folder, const std::string& kind, unsigned seed, const Body& body,
                const Disturbed& d) {
  const auto name = fmt::format("{}_{}", kind, seed);
  std::filesystem::create_directories(folder);
  write_label_image(d.image, folder / (name + ".nrrd"));
  std::ofstream file(folder / (name + ".yaml"));
  file << "geometry:\n  image:\n    file: " << name << ".nrrd\n";
  file << fmt::format("    true_lumen: {}\n    false_lumen: {}\n    openings:\n", d.settings.labels.true_lumen,
                      *d.settings.labels.false_lumen);
  for (const auto& [end, opening] : d.settings.openings)
    file << fmt::format("      {}: {{centre: [{:.2f} mm, {:.2f} mm, {:.2f} mm]}}\n", end, 1e3 * opening.centre[0],
                        1e3 * opening.centre[1], 1e3 * opening.centre[2]);
  if (d.settings.flap.insert) {
    file << fmt::format("    flap:\n      insert: {} m\n      tears:\n", *d.settings.flap.insert);
    for (const auto& tear : d.settings.flap.tears)
      file << fmt::format("        - {{centre: [{:.2f} mm, {:.2f} mm, {:.2f} mm], diameter: {:.2f} mm}}\n",
                          1e3 * tear.centre[0], 1e3 * tear.centre[1], 1e3 * tear.centre[2], 1e3 * tear.diameter);
  }
  if (const auto& label = d.settings.labels.thrombus) file << fmt::format("    thrombus: {}\n", *label);
  for (const auto& [repair, key] : {std::pair{Repair::slices, "slices"}, std::pair{Repair::bridges, "bridges"}})
    if (d.settings.repairs[repair]) file << "    repair: [" << key << "]\n";
  file << "    aorta_ends: [abdominal_aorta]\nsize: coarse\noutput: mesh_" << name << "\n";
  const auto& flap = body.shape.flap;
  const bool error = d.right == Right::error;
  std::ofstream(folder / (name + ".json")) << fmt::format(
      R"({{"kind": "{}", "what": "{}", "right": "{}", "lumen_ml": {:.3f}, "flap_mm": {:.3f}, "tears_mm2": [{:.1f}, {:.1f}], "openings": {}}})"
      "\n",
      kind, d.what, error ? "error" : "mesh", error ? 0 : 1e6 * lumen_volume(body.model), 1e3 * flap.thickness,
      1e6 * flap.entry.area, 1e6 * flap.exit.area, body.model.openings().size());
}

struct Count {
  int right = 0, refused = 0, wrong = 0;

  /// The outcome begins with "right", "refused" or "WRONG".
  void add(const std::string& outcome) { ++(outcome[0] == 'W' ? wrong : outcome.starts_with("ri") ? right : refused); }
};

/// Outcomes by trial, from a file with lines of trial, tabulator, outcome; new ones are added to it.
class Kept {
 public:
  explicit Kept(std::filesystem::path file) : file_(std::move(file)) {
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);)
      if (const auto end = line.find('\t'); end != std::string::npos)
        outcomes_[line.substr(0, end)] = line.substr(end + 1);
  }
  const std::string* find(const std::string& trial) const {
    const auto found = outcomes_.find(trial);
    return found == outcomes_.end() ? nullptr : &found->second;
  }
  void add(const std::string& trial, const std::string& outcome) const {
    if (!file_.empty()) std::ofstream(file_, std::ios::app) << trial << '\t' << outcome << std::endl;
  }

 private:
  std::filesystem::path file_;
  std::map<std::string, std::string> outcomes_;
};

/// One trial; returns its outcome in one line.
std::string run(const std::string& kind, unsigned seed) {
  std::mt19937 random(seed);
  const Body body(random);
  const auto d = kinds().at(kind)(body, random);
  const auto start = std::chrono::steady_clock::now();
  std::string outcome, figures;
  std::vector<std::string> lines;
  try {
    const auto made = surface_of(d.image, d.settings, [&](const std::string& line) { lines.push_back(line); });
    const auto wrong = d.right == Right::error ? " a surface in place of an error" : faults(body, kind, made, figures);
    outcome = wrong.empty() ? "right" : "WRONG" + wrong;
  } catch (const std::exception& error) {
    outcome = (d.right == Right::error ? "right, refused: " : "refused: ") + std::string(error.what());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::replace(outcome.begin(), outcome.end(), '\n', ' ');
  outcome += fmt::format("  {:.1f} s  [{}] {}", seconds, d.what, figures);
  std::printf("%-14s %4u  %s\n", kind.c_str(), seed, outcome.c_str());
  if (outcome.starts_with("WRONG") || outcome.starts_with("refused"))
    for (const auto& line : lines) std::printf("    %s\n", line.c_str());
  std::fflush(stdout);
  return outcome;
}

}  // namespace
}  // namespace tunica::imaging::trials

int main(int number, char** values) {
  using namespace tunica::imaging::trials;
  std::vector<std::string> words(values + 1, values + number);
  std::filesystem::path folder, file;
  if (words.size() >= 2 && (words[0] == "--write" || words[0] == "--keep")) {
    (words[0] == "--write" ? folder : file) = words[1];
    words.erase(words.begin(), words.begin() + 2);
  }
  const int trials = words.empty() ? 20 : std::stoi(words[0]);
  const auto seed = static_cast<unsigned>(words.size() < 2 ? 1 : std::stoi(words[1]));
  std::vector<std::string> names(words.begin() + std::min<std::ptrdiff_t>(2, std::ssize(words)), words.end());
  if (names.empty())
    for (const auto& [name, disturb] : kinds()) names.push_back(name);
  const Kept kept(file);
  Count count;
  for (int n = 0; n < trials; ++n) {
    const auto& kind = names[static_cast<std::size_t>(n) % names.size()];
    if (folder.empty()) {
      const auto trial = fmt::format("{} {}", kind, seed + static_cast<unsigned>(n));
      const auto* known = kept.find(trial);
      const auto outcome = known ? *known : run(kind, seed + static_cast<unsigned>(n));
      if (!known) kept.add(trial, outcome);
      count.add(outcome);
      continue;
    }
    std::mt19937 random(seed + static_cast<unsigned>(n));
    const Body body(random);
    write_case(folder, kind, seed + static_cast<unsigned>(n), body, kinds().at(kind)(body, random));
  }
  std::printf("%d right, %d refused that could be meshed, %d wrong\n", count.right, count.refused, count.wrong);
  return count.wrong == 0 ? 0 : 1;
}
