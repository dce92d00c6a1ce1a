// What a wall law costs, as a multiple of neo-Hooke in the same run on one core: stress and tangent at a point, batched
// over elements, for every instruction set of this machine; and the whole assembly of the wall.
//
//   benchmark_wall_laws
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "benchmark/laws/point_loops.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/coupling/wall_model.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::benchmarks {

extern template PointLoops make_point_loops<2>();
extern template PointLoops make_point_loops<4>();
extern template PointLoops make_point_loops<8>();

PointLoops point_loops(assembly::Isa isa) {
  if (isa == assembly::Isa::avx512) return make_point_loops<8>();
  return isa == assembly::Isa::avx2 ? make_point_loops<4>() : make_point_loops<2>();
}

namespace {

struct Candidate {
  std::string name;
  wall::LawParameters parameters;
  double asked_point = 0, asked_assembly = 0;  ///< multiples of neo-Hooke, 0 where nothing is asked
};

wall::ElasticConstants matrix() { return {.shear_modulus = 50e3, .bulk_modulus = 1e6}; }

wall::LawParameters dfd(wall::dfd::Rule rule, double second_angle) {
  wall::DfdParameters p;
  p.elastic = matrix();
  p.rule = rule;
  for (const double angle : {0.5, second_angle}) {
    wall::dfd::Family family;
    family.energy = {8e3, 12.0};
    family.orientation = wall::dfd::Symmetric{3.0, angle, {}};
    p.families.push_back(family);
  }
  return p;
}

std::vector<Candidate> candidates() {
  wall::HgoParameters hgo;
  hgo.elastic = matrix();
  wall::GohParameters goh;
  goh.elastic = matrix();
  for (const double angle : {0.5, -0.5}) {
    hgo.families.push_back({{8e3, 12.0}, angle});
    wall::GohParameters::Family family;
    family.energy = {8e3, 12.0};
    family.mean_angle = angle;
    family.kappa = 0.2;
    goh.families.push_back(family);
  }
  // Directions of both families: product rules of 32 and 64 each, and the 256 of the octahedron in common.
  return {{"neo-Hooke", wall::NeoHookeParameters{matrix()}},
          {"Mooney-Rivlin", wall::MooneyRivlinParameters{20e3, 5e3, {.bulk_modulus = 1e6}}},
          {"HGO, 2 families", hgo, 4.0},
          {"GOH, 2 families", goh, 4.0},
          {"DFD, 64 directions", dfd(wall::dfd::Product{4, 8}, -0.5), 9.0, 1.5},
          {"DFD, 128 directions", dfd(wall::dfd::Product{4, 16}, -0.5), 0.0, 1.9},
          {"DFD-256, 2 families merged", dfd(wall::dfd::Octahedral{256}, -0.5), 31.0}};
}

/// Of the processor, so that other processes on the machine count as little as can be.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Least time of each of `work`, in turns, so that a disturbance meets them all.
template <class Work>
std::vector<double> least_times(const std::vector<Work>& work, int rounds) {
  std::vector<double> best(work.size(), 1e300);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < work.size(); ++k) {
      const double start = seconds();
      work[k]();
      best[k] = std::min(best[k], seconds() - start);
    }
  return best;
}

void print_row(const Candidate& c, double time, double first, double asked, const std::string& more) {
  std::printf("  %-28s %9.2f %9.2f   ", c.name.c_str(), 1e9 * time, time / first);
  if (asked > 0)
    std::printf("<= %-6.3g %s", asked, time <= asked * first ? "ok  " : "MISS");
  else
    std::printf("%13s", "");
  std::printf("%s\n", more.c_str());
}

std::size_t directions(const wall::Law& law) {
  const auto* l = std::get_if<wall::DiscreteFibreLaw>(&law);
  return l == nullptr ? 0 : l->fibres.directions();
}

// Floating-point operations of one direction in a group of four: 4 of the strain, 23 of the exponential, 5 of slope and
// curvature, 4 of their combinations, 11 of the sums.
constexpr double operations_per_direction = 47.0;

void points(const std::vector<Candidate>& list, assembly::Isa isa) {
  constexpr int count = 512, repetitions = 10;
  const PointLoops loops = point_loops(isa);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  std::vector<double> F(9 * count), results(27 * count);
  for (int k = 0; k < 9 * count; ++k) F[k] = ((k / loops.width) % 9 % 4 == 0 ? 1.0 : 0.0) + uniform(random);
  std::vector<wall::Law> laws;
  for (const auto& c : list) laws.push_back(wall::make_law(c.parameters));
  std::vector<std::function<void()>> work;
  for (const auto& law : laws)
    work.push_back([&] {
      for (int r = 0; r < repetitions; ++r) loops.evaluate(law, count, F.data(), results.data());
    });
  double operations = 0, sink[8];
  work.push_back([&] { operations = loops.multiply_add(100000, sink); });
  auto times = least_times(work, 60);
  const double peak = operations / times.back();
  for (double& t : times) t /= count * repetitions;
  std::printf("%s, %d elements at a time, peak %.1f Gflop/s\n", assembly::name(isa), loops.width, 1e-9 * peak);
  std::printf("  %-28s %9s %9s   %s\n", "stress and tangent at a point", "ns", "ratio", "asked");
  for (std::size_t k = 0; k < list.size(); ++k) {
    std::string more;
    if (const auto n = static_cast<double>(directions(laws[k])); n > 0) {
      char text[96];
      const double each = (times[k] - times[0]) / n;
      std::snprintf(text, sizeof text, "  %3.0f directions, %.2f ns each, %.0f %% of the peak", n, 1e9 * each,
                    100.0 * operations_per_direction / each / peak);
      more = text;
    }
    print_row(list[k], times[k], times[0], list[k].asked_point, more);
  }
}

void assembly_of_the_wall(const std::vector<Candidate>& list) {
  const assembly::Isa isa = assembly::choose_isa();
  const auto mesh = distributed::distribute(mesh::tube({.radius = 0.01,
                                                        .length = 0.1,
                                                        .wall_thickness = 0.002,
                                                        .cells_around = 64,
                                                        .cells_radial = 8,
                                                        .cells_along = 64,
                                                        .cells_through_wall = 3}),
                                            MPI_COMM_WORLD);
  const auto pattern = assembly::make_pattern(mesh);
  assembly::BlockMatrix block_matrix(pattern);
  const std::size_t n = 4 * static_cast<std::size_t>(mesh.nodes());
  std::vector<double> X(n), u(n), v(n), a(n), residual(n);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = 4 * static_cast<std::size_t>(i) + static_cast<std::size_t>(c);
      X[k] = mesh.points[i][c];
      u[k] = 0.1 * mesh.points[i][(c + 1) % 3];
    }
  const coupling::FieldsView fields{X.data(), X.data(), v.data(), a.data(), v.data(), u.data()};
  std::vector<coupling::WallModel> models;
  models.reserve(list.size());
  std::vector<std::vector<coupling::WallModel::Group>> groups;
  std::size_t elements = 0;
  for (const auto& c : list) {
    wall::Parameters p;
    p.density = 1100;
    p.material = c.parameters;
    p.fibre_frame = wall::CylindricalFrame{};
    models.emplace_back(mesh, p);
    auto& of_law = groups.emplace_back();
    elements = 0;
    for (std::size_t r = 0; r < mesh.regions.size(); ++r)
      if (mesh.regions[r].kind == mesh::RegionKind::wall) {
        elements += mesh.regions[r].elements.size();
        for (auto& g : models.back().groups(mesh, r, pattern, static_cast<int>(isa))) of_law.push_back(std::move(g));
      }
  }
  std::vector<std::function<void()>> work;
  for (std::size_t k = 0; k < list.size(); ++k)
    work.push_back([&, k] {
      for (const auto& g : groups[k])
        coupling::element_loops(isa).wall.assemble(g.view(), fields, models[k].element_settings(), {1e4, 1e-4, 1e4},
                                                   {residual.data(), block_matrix.blocks.data()->a});
    });
  auto times = least_times(work, 25);
  for (double& t : times) t /= static_cast<double>(elements);
  std::printf("%s, whole assembly of the wall, mixed element, %zu elements\n", assembly::name(isa), elements);
  std::printf("  %-28s %9s %9s   %s\n", "residual, tangent, scatter", "ns", "ratio", "asked");
  for (std::size_t k = 0; k < list.size(); ++k) print_row(list[k], times[k], times[0], list[k].asked_assembly, "");
}

}  // namespace

}  // namespace tunica::benchmarks

int main(int argc, char** argv) {
  using namespace tunica;
  MPI_Init(&argc, &argv);
  {
    const parallel::Session session;
    const auto list = benchmarks::candidates();
    for (const auto isa : {assembly::Isa::sse2, assembly::Isa::avx2, assembly::Isa::avx512})
      if (static_cast<int>(isa) <= static_cast<int>(assembly::choose_isa())) benchmarks::points(list, isa);
    benchmarks::assembly_of_the_wall(list);
  }
  MPI_Finalize();
}
