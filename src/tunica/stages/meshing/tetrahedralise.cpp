// The only file with CGAL's Mesh_3: it takes a minute to compile and needs its own floating-point flags. A second kind
// of domain (surfaces instead of labels) is another argument of `refine`.
#include "tunica/stages/meshing/tetrahedralise.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_3/Mesher_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_map>

#include "tunica/base/error.hpp"

namespace tunica::stages::meshing {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using LabelledDomain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Labeled_mesh_domain_3<Kernel>>;

Point point(const Kernel::Point_3& p) { return {{p.x(), p.y(), p.z()}}; }
Kernel::Point_3 point(const Point& p) { return {p[0], p[1], p[2]}; }

LabelledDomain make_domain(const LabelDomain& domain) {
  const auto& [low, high] = domain.box;
  const double diagonal = norm(high - low);
  // Surface points are found by bisection; their error must be small against the thinnest wall, not against the body.
  const double error = 2e-6 / diagonal;
  const std::function<int(const Kernel::Point_3&)> label = [&domain](const Kernel::Point_3& p) {
    return domain.label(point(p));
  };
  const Kernel::Iso_cuboid_3 box(low[0], low[1], low[2], high[0], high[1], high[2]);
  LabelledDomain result(label, box, CGAL::parameters::relative_error_bound = error);
  std::vector<std::vector<Kernel::Point_3>> curves;
  for (const auto& curve : domain.curves) {
    auto& added = curves.emplace_back();
    for (const auto& p : curve) added.push_back(point(p));
  }
  result.add_features(curves.begin(), curves.end());
  return result;
}

/// Sizing fields as CGAL asks for them; `dimension` 3 is inside, 2 on a surface, 1 on a curve.
template <class Domain>
struct SurfaceSize {
  using FT = double;
  const LabelDomain& domain;
  FT operator()(const Kernel::Point_3& p, int, const typename Domain::Index&) const {
    return domain.surface_size(point(p));
  }
};
template <class Domain>
struct SurfaceDistance {
  using FT = double;
  const LabelDomain& domain;
  FT operator()(const Kernel::Point_3& p, int, const typename Domain::Index&) const {
    return domain.surface_distance(point(p));
  }
};
template <class Domain>
struct VolumeSize {
  using FT = double;
  const LabelDomain& domain;
  FT operator()(const Kernel::Point_3& p, int dimension, const typename Domain::Index& index) const {
    if (dimension < 3) return domain.surface_size(point(p));
    return domain.volume_size(point(p), boost::get<typename Domain::Subdomain_index>(index));
  }
};

struct Key {
  std::int64_t i, j, k;
  bool operator==(const Key&) const = default;
};
struct KeyHash {
  std::size_t operator()(const Key& c) const {
    return static_cast<std::size_t>((c.i * 73856093) ^ (c.j * 19349663) ^ (c.k * 83492791));
  }
};

/// Points that keep their distance: a hash grid with one cell for each smallest distance.
class Sparse {
 public:
  explicit Sparse(double cell) : cell_(cell) {}
  bool add(const Point& p, double distance) {
    const auto reach = static_cast<std::int64_t>(std::ceil(distance / cell_));
    const Key c = key(p);
    for (auto i = c.i - reach; i <= c.i + reach; ++i)
      for (auto j = c.j - reach; j <= c.j + reach; ++j)
        for (auto k = c.k - reach; k <= c.k + reach; ++k)
          if (const auto found = cells_.find({i, j, k}); found != cells_.end())
            for (const auto& q : found->second)
              if (norm(p - q) < distance) return false;
    cells_[c].push_back(p);
    return true;
  }

 private:
  Key key(const Point& p) const {
    const auto at = [&](int i) { return static_cast<std::int64_t>(std::floor(p[i] / cell_)); };
    return {at(0), at(1), at(2)};
  }
  double cell_;
  std::unordered_map<Key, std::vector<Point>, KeyHash> cells_;
};

Point bisect(const LabelDomain& domain, Point a, Point b, int label_a) {
  for (int k = 0; k < 20; ++k) {
    const Point middle = 0.5 * (a + b);
    (domain.label(middle) == label_a ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// Points on every surface, found by walking a lattice along one axis and bisecting where the label changes. Thin
/// sheets are then known to the refinement before it starts. No two are closer than `spacing` local sizes, and none is
/// near a curve, whose protecting balls must stay empty.
std::vector<Point> surface_samples(const LabelDomain& domain, double spacing) {
  constexpr double line_spacing = 2e-3, step = 5e-4;  // m: lines between samples, and steps along a line
  const Point extent = domain.box.high - domain.box.low;
  const auto count = [&](int i, double h) { return static_cast<int>(std::ceil(extent[i] / h)); };
  Sparse sparse(1e-3);
  for (const auto& curve : domain.curves)
    for (const auto& p : curve) sparse.add(p, 1e-5);
  std::vector<Point> samples;
  for (int i = 0; i <= count(0, line_spacing); ++i)
    for (int k = 0; k <= count(2, line_spacing); ++k) {
      Point a = domain.box.low + Point{{i * line_spacing, 0, k * line_spacing}};
      int label = domain.label(a);
      for (int j = 1; j <= count(1, step); ++j) {
        const Point b = domain.box.low + Point{{i * line_spacing, j * step, k * line_spacing}};
        const int next = domain.label(b);
        if (next != label) {
          const Point p = bisect(domain, a, b, label);
          if (sparse.add(p, spacing * domain.surface_size(p))) samples.push_back(p);
        }
        a = b;
        label = next;
      }
    }
  return samples;
}

template <class Complex, class Domain>
void insert_samples(Complex& complex, const Domain& cgal_domain, const LabelDomain& domain) {
  const auto samples = surface_samples(domain, 2.0);
  if (samples.empty()) throw SolverError("meshing: the label is the same everywhere, there is no surface");
  auto& triangulation = complex.triangulation();
  using Weighted = typename Complex::Triangulation::Weighted_point;
  for (const auto& p : samples) {
    const auto vertex = triangulation.insert(Weighted(point(p), 0.0));
    if (vertex == typename Complex::Vertex_handle()) continue;
    complex.set_dimension(vertex, 2);
    // The patch is made exact when the facets around the vertex are; any patch of the right dimension will do here.
    complex.set_index(vertex, cgal_domain.index_from_surface_patch_index({outside, lumen_label}));
  }
}

template <class Complex>
Tetrahedra extract(const Complex& complex) {
  Tetrahedra mesh;
  std::unordered_map<const void*, Index> number;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<Index, 4> nodes;
    for (int a = 0; a < 4; ++a) {
      const auto vertex = cell->vertex(a);
      const auto [entry, is_new] = number.emplace(&*vertex, std::ssize(mesh.points));
      if (is_new) {
        const auto& p = vertex->point();
        mesh.points.push_back({{p.x(), p.y(), p.z()}});
        mesh.on_curve.push_back(complex.in_dimension(vertex) <= 1);
      }
      nodes[a] = entry->second;
    }
    mesh.elements.push_back(nodes);
    mesh.labels.push_back(static_cast<int>(complex.subdomain_index(cell)));
  }
  return mesh;
}

/// Calls `show` at most twice a second.
class Pace {
 public:
  template <class Show>
  void operator()(const Show& show) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(500)) return;
    last_ = now;
    show();
  }

 private:
  std::chrono::steady_clock::time_point last_{};
};

template <class Domain>
Tetrahedra refine(const Domain& cgal_domain, const LabelDomain& domain, const MeshingProgress& progress) {
  using Triangulation = typename CGAL::Mesh_triangulation_3<Domain>::type;
  using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, typename Domain::Corner_index,
                                                          typename Domain::Curve_index>;
  using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
  namespace p = CGAL::parameters;
  const SurfaceSize<Domain> surface{domain};
  const Criteria criteria(p::edge_size = surface, p::facet_angle = 25.0, p::facet_size = surface,
                          p::facet_distance = SurfaceDistance<Domain>{domain}, p::cell_radius_edge_ratio = 2.0,
                          p::cell_size = VolumeSize<Domain>{domain});
  CGAL::get_default_random() = CGAL::Random(0);
  Complex complex;
  progress("curves and first points", "");
  CGAL::Mesh_3::internal::init_c3t3_with_features(complex, cgal_domain, criteria);
  insert_samples(complex, cgal_domain, domain);

  CGAL::Mesh_3::Mesher_3<Complex, Criteria, Domain> mesher(complex, cgal_domain, criteria,
                                                           CGAL::FACET_VERTICES_ON_SURFACE);
  progress("refinement", "");
  mesher.initialize();
  Pace pace;
  while (!mesher.is_algorithm_done()) {
    mesher.one_step();
    pace([&] { progress("refinement", fmt::format("{} points", complex.triangulation().number_of_vertices())); });
  }
  return extract(complex);
}

}  // namespace

Tetrahedra tetrahedralise(const LabelDomain& domain, const MeshingProgress& progress) {
  return refine(make_domain(domain), domain, progress);
}

}  // namespace tunica::stages::meshing
