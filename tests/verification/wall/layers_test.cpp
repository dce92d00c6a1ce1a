// A thick tube of two layers under pressure, plane strain, against the solution along the radius.
#include "tunica/wall/material_paths.hpp"
#include "verification/wall/cylinder.hpp"
#include "verification/wall/helical_fibres.hpp"

namespace tunica::verification {
namespace {

constexpr double p = 80 * 133.322;        // Pa
constexpr double border = 0.5 * (A + B);  // m

/// Media with fibres along two directions, most of them around.
wall::HgoParameters media() {
  wall::HgoParameters law;
  law.elastic.shear_modulus = 60e3;
  law.elastic.poisson_ratio = 0.5;
  for (const double angle : {0.3, -0.3}) law.families.push_back({.energy = {80e3, 4.0}, .mean_angle = angle});
  return law;
}

wall::Layers layers(double blending) {
  return {.depth = "depth", .blending = blending, .outwards = {{.beyond = 0.5, .material = helical(0.5)}}};
}

/// Incompressible: r^2 = R^2 + a^2 - A^2, and equilibrium integrated over the wall gives the pressure that opens the
/// inner radius to a. Directions of the two families of each layer balance, so that the axes stay principal ones.
class LayeredTube {
 public:
  explicit LayeredTube(double blending) : layers_(layers(blending)) {}

  double pressure(double a) const {
    double sum = 0;
    for (int quarter = 0; quarter < 4; ++quarter)  // the blend has its kinks between them
      sum += over(A + (B - A) * quarter / 4, A + (B - A) * (quarter + 1) / 4, a);
    return sum;
  }
  /// Inner radius under a pressure.
  double inner_radius(double under) const {
    double low = A, high = 1.5 * A;
    for (int i = 0; i < 45; ++i) {
      const double middle = 0.5 * (low + high);
      (pressure(middle) < under ? low : high) = middle;
    }
    return low;
  }

 private:
  /// sigma_tt - sigma_rr = sigma_11 - sigma_33 in the fibre frame.
  static double difference(const wall::Law& law, double stretch) {
    Mat3<double> F = identity<double>();
    F(0, 0) = stretch, F(2, 2) = 1 / stretch;
    const auto point = wall::deformed(law, {VolumetricEnergy::simo_taylor, INFINITY}, F);
    const auto along = [&](const Vec3<double>& n) {
      return wall::stress_component(point, wall::StressMeasure::cauchy, n, n);
    };
    return along({{1, 0, 0}}) - along({{0, 0, 1}});
  }
  double over(double from, double to, double a) const {
    constexpr int n = 16;  // Simpson, over R: dr / r = R dR / r^2
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double R = from + (to - from) * i / n, square = R * R + a * a - A * A, stretch = std::sqrt(square) / R;
      // Just inside the interval, where a jump lies at its end.
      const double nudge = i == 0 ? 1e-9 : i == n ? -1e-9 : 0.0;
      const auto w = layers_.weights((R - A) / (B - A) + nudge);
      const double both = w[0] * difference(media_, stretch) + w[1] * difference(adventitia_, stretch);
      sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * both * R / square;
    }
    return sum * (to - from) / (3 * n);
  }
  wall::Layers layers_;
  wall::Law media_ = wall::make_law(media()), adventitia_ = wall::make_law(helical(0.5));
};

mesh::MeshData with_depth(mesh::MeshData data) {
  mesh::ElementField depth{"depth", 4, {}};
  for (const auto& t : data.tetrahedra)
    for (const auto node : t)
      depth.values.push_back((std::hypot(data.points[node][0], data.points[node][1]) - A) / (B - A));
  data.fields.push_back(depth);
  return data;
}

double inner_displacement(int radial, Order order, double blending) {
  const auto mesh = share(with_depth(mesh::thick_cylinder(sizes(radial), mesh::Sector::quarter)), order);
  auto in = fibre_input(Element::mixed, media(), plane_strain(bc::Pressure{bc::WaveformInput{p}}, bc::Free{}));
  in.wall->composition.layers = layers(blending);
  Problem problem(mesh, in);
  State state = problem.initial_state();
  for (int k = 1; k <= 4; ++k) {
    const auto report = problem.solve_static(state, 0.25 * k);
    EXPECT_TRUE(report.converged) << report.failure;
  }
  return radial_displacement(mesh, state, "wall_inner");
}

/// Returns the order between the last two meshes, and the error on the last one.
std::pair<double, double> convergence(Order order, double blending, int first, int last) {
  const double exact = LayeredTube(blending).inner_radius(p) - A;
  print(" %s elements, layers %s: inner face moves by %.5f mm\n", verification::name(order),
        blending > 0 ? "blended over half of the wall" : "with a sharp border", 1e3 * exact);
  double error = 0, rate = 0;
  for (int radial = first; radial <= last; radial *= 2) {
    const double before = error;
    error = inner_displacement(radial, order, blending) / exact - 1;
    rate = std::log2(std::abs(before / error));
    print("  %d through the wall: error %+.4f %%", radial, 100 * error);
    if (radial > first) print(", order %.2f", rate);
    print("\n");
  }
  return {rate, std::abs(error)};
}

/// Asked: order 1.8.
TEST(LayeredTube, BlendedLayersConvergeToTheSolutionAlongTheRadius) {
  const auto [linear, linear_error] = convergence(Order::linear, 0.5, 4, 8);
  EXPECT_GT(linear, 1.8);
  EXPECT_LT(linear_error, 2e-3);
  const auto [quadratic, quadratic_error] = convergence(Order::quadratic, 0.5, 4, 8);
  EXPECT_GT(quadratic, 1.8);
  EXPECT_LT(quadratic_error, 3e-4);
}

/// The pressure unknown is continuous and that of the layers is not: at a sharp border the mixed element loses an
/// order.
TEST(LayeredTube, SharpBordersConvergeToTheSolutionAlongTheRadius) {
  const auto [order, error] = convergence(Order::linear, 0.0, 4, 8);
  EXPECT_GT(order, 0.85);
  EXPECT_LT(error, 8e-3);
}

}  // namespace
}  // namespace tunica::verification
