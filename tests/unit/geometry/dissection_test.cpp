#include <gtest/gtest.h>

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/config/description.hpp"
#include "tunica/geometry/dissection_model.hpp"

namespace tunica::geometry {
namespace {

using std::numbers::pi;

geometry::ParametricDissection parse(const std::string& yaml) {
  return config::parse_text(geometry::ParametricDissection::schema(), yaml).value;
}

std::string refusal(const std::string& yaml) {
  try {
    parse(yaml);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

const std::string everything = "{celiac: {}, superior_mesenteric: {}, left_renal: {}, right_renal: {}, iliacs: {}}";

TEST(ParametricDissection, SchemaIsSoundAndTheUsualOneIsPossible) {
  EXPECT_EQ(refusal("{}"), "");
  EXPECT_EQ(refusal(everything), "");
  EXPECT_EQ(parse(everything).branches().size(), 7U);
  EXPECT_EQ(geometry::impossibilities(geometry::ParametricDissection{}).errors.size(), 0U);
}

TEST(ParametricDissection, ImpossibleOnesAreRefusedWithTheReason) {
  const std::pair<const char*, const char*> cases[] = {
      {"flap: {entry_tear: {area: 900 mm^2}}", "flap there has a width"},
      {"flap: {entry_tear: {across: 9 mm}}", "off the middle"},
      {"flap: {entry_tear: {position: 180 mm}}", "where the flap leaves the wall"},
      {"flap: {exit_tear: {position: 225 mm}}", "after the entry tear"},
      {"flap: {true_lumen_share: 0.15, thickness: 4 mm, rim_fillet: 1 mm, bow: 8 mm}", "true lumen"},
      {"flap: {thickness: 1 mm, rim_fillet: 0.8 mm}", "half the thickness"},
      {"flap: {length: 320 mm}", "the aorta is"},
      {"flap: {start: 40 mm}", "no type-B"},
      {"flap: {length: 80 mm, taper: 40 mm}", "between the tapers"},
      {"aorta: {arch_bend_radius: 20 mm, ascending_radius: 17 mm, dissected_radius: 17 mm}", "touch"},
      {"aorta: {arch_bend_radius: 25 mm, ascending_radius: 30 mm}", "overlap itself"},
      {"left_common_carotid: {position: 106 mm}", "overlaps"},
      {"brachiocephalic: {radius: 12 mm}", "the aorta there has"},
      {"left_subclavian: {position: 160 mm}", "dissected part"},
      {"celiac: {position: 350 mm}", "dissected part"},
      {"celiac: {position: 449 mm}", "beyond an end"},
      {"brachiocephalic: {length: 10 mm, inclination: -60 deg, angle: 0 deg}", "too near the aorta"},
      {"iliacs: {radius: 9 mm}", "iliacs.radius"},
      {"iliacs: {angle: 15 deg, length: 20 mm}", "apart"},
      {"thrombus: {start: 180 mm}", "place it between"},
      {"thrombus: {length: 25 mm}", "at either end"},
      {"thrombus: {thickness: 20 mm}", "the false lumen there is"},
  };
  for (const auto& [yaml, reason] : cases)
    EXPECT_NE(refusal(yaml).find(reason), std::string::npos) << yaml << "\n" << refusal(yaml);
}

TEST(ParametricDissection, RangesAndUnitsAreChecked) {
  EXPECT_NE(refusal("flap: {thickness: 1.75}").find("unit"), std::string::npos);
  EXPECT_NE(refusal("aorta: {wall_thickness: 9 mm}").find("<= 0.005 m"), std::string::npos)
      << refusal("aorta: {wall_thickness: 9 mm}");
  EXPECT_NE(refusal("coeliac: {}").find("celiac"), std::string::npos);
}

TEST(DissectionModel, OpeningsAreRoundAndPlane) {
  const geometry::DissectionModel model(parse(everything));
  ASSERT_EQ(model.openings().size(), 10U);
  EXPECT_EQ(model.openings()[0].name, "inlet");
  for (const auto& o : model.openings()) {
    const geometry::Point other = std::abs(o.normal[0]) < 0.7 ? geometry::Point{{1, 0, 0}} : geometry::Point{{0, 1, 0}};
    geometry::Point a = cross(o.normal, other);
    a = (1 / norm(a)) * a;
    const geometry::Point b = cross(o.normal, a);
    const double eps = 2e-6;
    for (double angle = 0; angle < 2 * pi; angle += 0.3) {
      const geometry::Point d = std::cos(angle) * a + std::sin(angle) * b;
      const auto label = [&](double radius, double along) {
        return model.label(o.centre + radius * d + along * o.normal);
      };
      EXPECT_EQ(label(o.lumen_radius - eps, -eps), geometry::lumen_label) << o.name;
      EXPECT_EQ(label(o.lumen_radius + eps, -eps), geometry::wall_label) << o.name;
      EXPECT_EQ(label(o.outer_radius - eps, -eps), geometry::wall_label) << o.name;
      EXPECT_EQ(label(o.outer_radius + eps, -eps), geometry::outside_label) << o.name;
      EXPECT_EQ(label(o.lumen_radius - eps, eps), geometry::outside_label) << o.name;
    }
  }
}

TEST(DissectionModel, FlapHasItsThicknessAndSharesTheCrossSection) {
  const geometry::ParametricDissection shape;
  const geometry::DissectionModel model(shape);
  const double s = 265e-3, R = shape.aorta.dissected_radius;  // between the tears
  const geometry::Frame f = model.centreline().frame(s);
  const double turn =
      shape.flap.true_lumen_direction + 2 * pi * shape.flap.turns * (s - shape.flap.start) / shape.flap.length;
  const geometry::Point n = std::cos(turn) * f.e1 + std::sin(turn) * f.e2;
  // Along a diameter: wall, false lumen, flap, true lumen, wall.
  double flap = 0, first = 1, last = -1;
  const double step = 1e-6;
  for (double x = -R + 1e-3; x < R - 1e-3; x += step)
    if (model.label(f.origin + x * n) == geometry::wall_label) {
      flap += step;
      first = std::min(first, x);
      last = std::max(last, x);
    }
  EXPECT_NEAR(flap, shape.flap.thickness, 5e-6);
  EXPECT_NEAR(last - first, flap, 5e-6);
  // Off the middle the flap is inclined to that line, by its bow and by its turning.
  const double off = 8e-3, bent = 2 * shape.flap.bow * off / (R * R),
               turned = 2 * pi * shape.flap.turns / shape.flap.length * off;
  const geometry::Point aside = cross(f.tangent, n);
  double inclined = 0;
  for (double x = -6e-3; x < 8e-3; x += step)
    if (model.label(f.origin + off * aside + x * n) == geometry::wall_label) inclined += step;
  EXPECT_NEAR(inclined, shape.flap.thickness * std::sqrt(1 + bent * bent + turned * turned), 5e-6);
  // True lumen and half of the flap have the wanted share of the cross-section.
  const geometry::Point& m = aside;
  double of_true = 0, of_all = 0;
  const double h = 0.1e-3;
  for (double x = -R; x < R; x += h)
    for (double y = -R; y < R; y += h)
      if (x * x + y * y < R * R) {
        of_all += h * h;
        if (model.at(f.origin + x * n + y * m).side > 0) of_true += h * h;
      }
  EXPECT_NEAR(of_true / of_all, shape.flap.true_lumen_share, 0.01);
  // The walls: over the false lumen and over the true one.
  const auto thickness = [&](double sign) {
    double sum = 0;
    for (double x = 0.5 * R; x < R + 5e-3; x += step)
      sum += model.label(f.origin + (sign * x) * n) == geometry::wall_label ? step : 0;
    return sum;
  };
  EXPECT_NEAR(thickness(-1), shape.flap.false_lumen_wall_thickness, 5e-6);
  EXPECT_NEAR(thickness(1), shape.aorta.wall_thickness, 5e-6);
}

TEST(DissectionModel, ThrombusIsAsThickAsAskedAndLeavesTheWallAsItIs) {
  const auto shape = parse("thrombus: {thickness: 6 mm}");
  const geometry::DissectionModel model(shape), without(parse("{}"));
  const double s = 262e-3, R = shape.aorta.dissected_radius;  // between its ends
  const geometry::Frame f = model.centreline().frame(s);
  const double turn =
      shape.flap.true_lumen_direction + 2 * pi * shape.flap.turns * (s - shape.flap.start) / shape.flap.length;
  const geometry::Point n = std::cos(turn) * f.e1 + std::sin(turn) * f.e2;
  double clot = 0;
  const double step = 1e-6;
  for (double x = -R - 3e-3; x < R + 3e-3; x += step) {
    const auto values = model.at(f.origin + x * n), before = without.at(f.origin + x * n);
    EXPECT_DOUBLE_EQ(values.vessel, before.lumen);
    EXPECT_DOUBLE_EQ(values.outer, before.outer);
    if (values.lumen < 0 || values.vessel >= 0) continue;
    clot += step;
    EXPECT_LT(values.side, 0) << "in the false lumen";
  }
  EXPECT_NEAR(clot, shape.thrombus->thickness, 5e-6);
  // Neither before nor behind it.
  for (const double elsewhere : {220e-3, 305e-3}) {
    const auto p = model.centreline().frame(elsewhere).origin - 0.9 * R * n;
    EXPECT_DOUBLE_EQ(model.at(p).lumen, without.at(p).lumen);
  }
}

/// Area of the holes in the middle surface of the flap, by summing over a grid on it.
TEST(DissectionModel, TearsHaveTheirAreas) {
  const geometry::ParametricDissection shape;
  const geometry::DissectionModel model(shape);
  const auto on_middle = [&](double s, double m) {
    const geometry::Frame f = model.centreline().frame(s);
    const double turn =
        shape.flap.true_lumen_direction + 2 * pi * shape.flap.turns * (s - shape.flap.start) / shape.flap.length;
    const geometry::Point across = std::cos(turn + pi / 2) * f.e1 + std::sin(turn + pi / 2) * f.e2;
    const geometry::Point n = std::cos(turn) * f.e1 + std::sin(turn) * f.e2;
    double low = -10e-3, high = 10e-3;
    for (int k = 0; k < 30; ++k) {
      const double middle = 0.5 * (low + high);
      (model.at(f.origin + m * across + middle * n).side > 0 ? high : low) = middle;
    }
    return f.origin + m * across + low * n;
  };
  for (const geometry::TearShape& tear : {shape.flap.entry, shape.flap.exit}) {
    const double h = 0.25e-3;
    double area = 0;
    for (double s = tear.position - 14e-3; s < tear.position + 14e-3; s += h)
      for (double m = -9e-3; m < 9e-3; m += h) {
        const geometry::Point p = on_middle(s, m);
        if (model.label(p) == geometry::lumen_label)
          area += norm(cross(on_middle(s + h, m) - p, on_middle(s, m + h) - p));
      }
    EXPECT_NEAR(area / tear.area, 1, 0.02);
  }
}

}  // namespace
}  // namespace tunica::geometry
