// What becomes of segmentations with the faults that observers, networks and scanners make.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "small_images.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/imaging/label_surface.hpp"

namespace tunica::imaging {
namespace {

using tunica::test::contains;
using namespace testing;

/// A tube of radius 7 mm between z = -20 and 20 mm with a false lumen at x < 0 of |z| < 14 mm behind a flap of 2.1 mm,
/// which has two holes of 3 mm radius.
int dissected_tube(const Point& p) {
  if (std::hypot(p[0], p[1]) >= 7 * mm || std::abs(p[2]) >= 20 * mm) return 0;
  const bool hole = std::hypot(p[1], p[2] - 8 * mm) < 3 * mm || std::hypot(p[1], p[2] + 8 * mm) < 3 * mm;
  const bool wall =
      p[0] < 1.05 * mm && std::abs(p[2]) < 16 * mm && (std::abs(p[0]) < 1.05 * mm ? !hole : std::abs(p[2]) > 14 * mm);
  return wall ? 0 : p[0] < 0 && std::abs(p[2]) < 14 * mm ? 2 : 1;
}

const Size3 image_size{26, 26, 62};

SurfaceSettings settings() {
  SurfaceSettings result;
  result.labels = {1, 2};
  result.openings = {{"inlet", {{{0, 0, -20 * mm}}, {}}}, {"outlet", {{{0, 0, 20 * mm}}, {}}}};
  return result;
}

struct Made {
  std::int64_t genus = -1;
  LabelSurface surface{};
  std::string log;
  std::string error;
};

Made make(const LabelImage& image, const SurfaceSettings& asked) {
  Made made;
  try {
    made.surface = surface_of(image, asked, [&](const std::string& line) { made.log += line + "\n"; });
    made.genus = geometry::genus(made.surface.lumen, std::ssize(made.surface.ends)) + made.surface.parts - 1;
  } catch (const std::exception& error) {
    made.error = error.what();
  }
  return made;
}

TEST(FaultyLabels, WithoutAnyAreMeshed) {
  const auto made = make(image_of(dissected_tube, image_size, straight), settings());
  EXPECT_EQ(made.genus, 1) << made.log << made.error;
  EXPECT_EQ(made.surface.ends.size(), 2U);
  EXPECT_EQ(made.surface.tears.size(), 2U);
}

TEST(FaultyLabels, TwoFalseLumensAreAnErrorAndSoIsOneWithoutATear) {
  const double scale = 2;  // so that each has more than 1 ml
  auto steps = straight;
  for (auto& step : steps) step = scale * step;
  auto asked = settings();
  for (auto& [name, opening] : asked.openings) opening.centre = scale * opening.centre;
  const auto two = [&](const Point& p) {
    const Point q = (1 / scale) * p;
    return dissected_tube(q) == 2 && std::abs(q[2]) < 2 * mm ? 0 : dissected_tube(q);
  };
  const auto parted = make(image_of(two, image_size, steps), asked);
  EXPECT_TRUE(contains(parted.error, "through the true lumen only: there are two false lumens")) << parted.log;
  asked.repairs.asked[static_cast<std::size_t>(Repair::pieces)] = true;
  const auto counted = make(image_of(two, image_size, steps), asked);
  EXPECT_TRUE(contains(counted.log, "of the false lumen hang on the other lumen only")) << counted.log << counted.error;
  asked.repairs = {};
  const auto closed = [&](const Point& p) {
    const Point q = (1 / scale) * p;
    return std::abs(q[0]) < 1.05 * mm && std::abs(q[2]) < 14 * mm ? 0 : dissected_tube(q);
  };
  EXPECT_TRUE(contains(make(image_of(closed, image_size, steps), asked).error, "no tear joins the lumens"));
}

TEST(FaultyLabels, AnEndThatIsFarFromItsOpeningIsWarnedOf) {
  auto asked = settings();
  asked.openings[1].second.centre = {{0, 0, 31 * mm}};
  const auto made = make(image_of(dissected_tube, image_size, straight), asked);
  EXPECT_TRUE(contains(made.log, "warning: opening outlet: the vessel end nearest to its centre is 10.7 mm away"))
      << made.log << made.error;
}

TEST(FaultyLabels, ASmallHoleInTheFlapIsClosedAndListed) {
  const auto image = image_of(
      [](const Point& p) {
        if (std::abs(p[0]) < 1.05 * mm && std::hypot(p[1] - 1 * mm, p[2]) < 1.1 * mm) return p[0] < 0 ? 2 : 1;
        return dissected_tube(p);
      },
      image_size, straight);
  auto asked = settings();
  const auto closed = make(image, asked);
  EXPECT_EQ(closed.genus, 1) << closed.log << closed.error;
  EXPECT_TRUE(contains(closed.log, "closed: smaller than `smallest_tear`")) << closed.log;
  asked.tears.smallest = 1e-6;
  const auto open = make(image, asked);
  EXPECT_EQ(open.genus, 2) << open.log << open.error;
  EXPECT_EQ(open.surface.tears.size(), 3U);
}

Label touching() {
  return [](const Point& p) {
    if (std::hypot(p[0], p[1]) >= 7 * mm || std::abs(p[2]) >= 20 * mm) return 0;
    return p[0] < 0 && std::abs(p[2]) < 14 * mm ? 2 : 1;
  };
}

TEST(FaultyLabels, LumensThatTouchAllAlongHaveNoFlap) {
  const auto image = image_of(touching(), image_size, straight);
  EXPECT_TRUE(contains(make(image, settings()).error, "the labels have no flap"));
}

TEST(FaultyLabels, AFlapIsInsertedWithTheTearsThatAreGiven) {
  const auto image = image_of(touching(), image_size, straight);
  auto asked = settings();
  asked.flap.insert = 1.8 * mm;
  const auto apart = make(image, asked);
  EXPECT_EQ(apart.surface.parts, 2) << apart.error;
  EXPECT_EQ(apart.genus, 0) << apart.log << apart.error;
  asked.flap.tears = {{{{0, 0, -7 * mm}}, 6 * mm}, {{{0, 0, 7 * mm}}, 6 * mm}};
  const auto joined = make(image, asked);
  EXPECT_EQ(joined.genus, 1) << joined.log << joined.error;
  asked.flap.tears = {{{{0, 0, 40 * mm}}, 6 * mm}};
  EXPECT_TRUE(contains(make(image, asked).error, "no surface between the lumens")) << make(image, asked).error;
}

TEST(FaultyLabels, AMissingSliceIsNamedOrFilled) {
  const auto image =
      image_of([](const Point& p) { return std::abs(p[2] - 0.35 * mm) < 0.3 * mm ? 0 : dissected_tube(p); }, image_size,
               straight);
  auto asked = settings();
  EXPECT_TRUE(contains(make(image, asked).error, "slice 31 along axis 3")) << make(image, asked).error;
  asked.repairs.asked[static_cast<std::size_t>(Repair::slices)] = true;
  const auto filled = make(image, asked);
  EXPECT_EQ(filled.genus, 1) << filled.log << filled.error;
}

TEST(FaultyLabels, AFlapAlongTheSlicesOfOneLabelIsNoMissingSlice) {
  const auto image = image_of([](const Point& p) { return dissected_tube(p) != 0 ? 1 : 0; }, image_size, straight);
  auto asked = settings();
  asked.labels = {1, std::nullopt};
  const auto made = make(image, asked);
  EXPECT_EQ(made.genus, 1) << made.log << made.error;
}

TEST(FaultyLabels, ALabelThatNothingNamesIsAnError) {
  const auto image =
      image_of([](const Point& p) { return p[2] > 5 * mm && dissected_tube(p) == 2 ? 5 : dissected_tube(p); },
               image_size, straight);
  auto asked = settings();
  EXPECT_TRUE(contains(make(image, asked).error, "nothing says what they are")) << make(image, asked).error;
  asked.labels.tissue = {5};
  const auto made = make(image, asked);
  EXPECT_EQ(made.surface.tears.size(), 1U) << made.log << made.error;
  EXPECT_EQ(made.genus, 0) << made.log << made.error;
}

/// Of a surface closed by plane fans.
double volume(geometry::TriangleSurface surface) {
  for (const auto& loop : geometry::boundary_loops(surface)) {
    surface.points.push_back(surface.points[loop.front()]);
    for (std::size_t i = 0; i < loop.size(); ++i)
      surface.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], std::ssize(surface.points) - 1});
  }
  return geometry::enclosed_volume(surface);
}

TEST(FaultyLabels, ThrombusIsNoLumenButLiesWithinTheWall) {
  const auto clotted = [](const Point& p) {
    return dissected_tube(p) == 2 && p[0] < -3.5 * mm ? 3 : dissected_tube(p);
  };
  const auto image = image_of(clotted, image_size, straight);
  auto asked = settings();
  EXPECT_TRUE(contains(make(image, asked).error, "give `thrombus: 3` for clotted blood"));
  asked.labels.thrombus = 3;
  const auto made = make(image, asked);
  ASSERT_EQ(made.genus, 1) << made.log << made.error;
  EXPECT_TRUE(contains(made.log, "thrombus: wall, which goes around it")) << made.log;
  ASSERT_TRUE(made.surface.with_thrombus);
  EXPECT_EQ(geometry::boundary_loops(*made.surface.with_thrombus).size(), 2U);
  // The clot, and the flap where both surfaces are one.
  const double clot =
      static_cast<double>(std::count(image.labels.begin(), image.labels.end(), 3)) * image.frame.voxel_volume();
  EXPECT_GT(volume(*made.surface.with_thrombus) - volume(made.surface.lumen), 0.9 * clot);
  asked.labels.thrombus = 2;
  EXPECT_TRUE(contains(make(image, asked).error, "label 2 is a lumen"));
}

TEST(FaultyLabels, TheFilterMayBeGivenAsALength) {
  const auto image = image_of(dissected_tube, image_size, straight);
  auto asked = settings();
  const auto by_voxels = make(image, asked);
  asked.smoothing_length = asked.smoothing * 0.7 * mm;
  const auto by_length = make(image, asked);
  ASSERT_EQ(by_length.surface.lumen.points.size(), by_voxels.surface.lumen.points.size()) << by_length.error;
  for (std::size_t p = 0; p < by_length.surface.lumen.points.size(); ++p)
    EXPECT_LT(norm(by_length.surface.lumen.points[p] - by_voxels.surface.lumen.points[p]), 1e-9);
  asked.smoothing_length = 3 * mm;
  EXPECT_TRUE(contains(make(image, asked).error, "give 0.35 to 1.40 mm"));
}

TEST(FaultyLabels, EveryPointOfTheSurfaceKnowsItsLumen) {
  const auto made = make(image_of(dissected_tube, image_size, straight), settings());
  ASSERT_EQ(made.surface.of_false_lumen.size(), made.surface.lumen.points.size());
  for (std::size_t p = 0; p < made.surface.lumen.points.size(); ++p) {
    const auto& x = made.surface.lumen.points[p];
    if (std::abs(x[0]) > 2 * mm) {
      EXPECT_EQ(made.surface.of_false_lumen[p] != 0, x[0] < 0 && std::abs(x[2]) < 15 * mm);
    }
  }
}

TEST(FaultyLabels, AThinFlapStaysClosed) {
  const auto image = image_of(
      [](const Point& p) {
        const int label = dissected_tube(p);
        const bool flap =
            label == 0 && std::abs(p[0]) < 1.05 * mm && std::hypot(p[0], p[1]) < 7 * mm && std::abs(p[2]) < 13.5 * mm;
        if (!flap || std::abs(p[0] - 0.35 * mm) < 0.3 * mm) return label;  // one voxel is left
        return p[0] < 0 ? 2 : 1;
      },
      image_size, straight);
  const auto made = make(image, settings());
  EXPECT_EQ(made.genus, 1) << made.log << made.error;
}

TEST(FaultyLabels, ThickSlicesAndCoarseVoxelsKeepTheTopology) {
  // Cut by planes, since three voxels of a wide vessel beyond the flap show no end.
  auto asked = settings();
  asked.openings = {{"inlet", {{{0, 0, -19 * mm}}, Vec3<double>{{0, 0, -1}}}},
                    {"outlet", {{{0, 0, 19 * mm}}, Vec3<double>{{0, 0, 1}}}}};
  auto steps = straight;
  steps[2] = {{0, 0, 2.1 * mm}};
  const auto thick = make(image_of(dissected_tube, {26, 26, 22}, steps), asked);
  EXPECT_EQ(thick.genus, 1) << thick.log << thick.error;
  for (int d = 0; d < 3; ++d) steps[d] = 2.0 * straight[d];
  const auto coarse = make(image_of(dissected_tube, {14, 14, 32}, steps), asked);
  EXPECT_EQ(coarse.genus, 1) << coarse.log << coarse.error;
}

TEST(FaultyLabels, ARoundEndIsCutWhereTheVesselIsWhole) {
  // 60 % of a half-sphere, at the upper end of a tube.
  const auto image = image_of(
      [](const Point& p) {
        const double off = std::hypot(p[0], p[1]) / (7 * mm);
        const double top = 20 * mm - 4.2 * mm * (1 - std::sqrt(std::max(0.0, 1 - off * off)));
        return off < 1 && p[2] > -20 * mm && p[2] < top;
      },
      image_size, straight);
  auto asked = settings();
  asked.labels.false_lumen = {};
  const auto made = make(image, asked);
  ASSERT_EQ(made.surface.ends.size(), 2U) << made.error;
  EXPECT_GT(made.surface.ends[1].normal[2], 0.98);
  EXPECT_NEAR(made.surface.ends[1].centre[2] / mm, 17.5, 2);
  EXPECT_TRUE(contains(made.log, "normal: [")) << made.log;
}

TEST(FaultyLabels, TheWidestEndMustBeNamed) {
  // A branch of 3 mm whose end is called the inlet.
  const auto image = image_of(
      [](const Point& p) {
        return (std::hypot(p[0], p[1]) < 6 * mm && std::abs(p[2]) < 20 * mm) ||
               (std::hypot(p[1], p[2]) < 3 * mm && p[0] > 0 && p[0] < 18 * mm);
      },
      {60, 26, 62}, straight);
  SurfaceSettings asked;
  asked.openings = {{"inlet", {{{16 * mm, 0, 0}}, Vec3<double>{{1, 0, 0}}}}, {"outlet", {{{0, 0, 20 * mm}}, {}}}};
  EXPECT_TRUE(contains(make(image, asked).error, "is wider than the inlet")) << make(image, asked).error;
}

/// Two legs of 3 mm that part from a trunk, joined again by a bridge of 1.2 mm; at the end of the trunk a false lumen.
int bridged(const Point& p) {
  const bool trunk = std::abs(p[0]) < 9 * mm && std::hypot(p[1], p[2] + 18 * mm) < 4 * mm;
  const bool leg = std::hypot(std::abs(p[0]) - 6 * mm, p[1]) < 3 * mm && p[2] > -18 * mm && p[2] < 20 * mm;
  const bool bridge = std::abs(p[0]) < 6 * mm && std::hypot(p[1], p[2] - 5 * mm) < 1.2 * mm;
  const bool end = p[0] >= 9 * mm && p[0] < 13 * mm && std::hypot(p[1], p[2] + 18 * mm) < 3 * mm;
  return trunk || leg || bridge ? 1 : end ? 2 : 0;
}

TEST(FaultyLabels, ABridgeBetweenVesselsIsNamedOrCut) {
  const auto image = image_of(bridged, {40, 20, 70}, straight);
  SurfaceSettings asked;
  asked.labels.false_lumen = 2;
  asked.tears.most_open = 1;
  asked.openings = {{"left", {{{-6 * mm, 0, 20 * mm}}, {}}}, {"right", {{{6 * mm, 0, 20 * mm}}, {}}}};
  const auto refused = make(image, asked);
  EXPECT_TRUE(contains(refused.error, "vessels are joined by a bridge at")) << refused.log << refused.error;
  asked.repairs.asked[static_cast<std::size_t>(Repair::bridges)] = true;
  const auto cut = make(image, asked);
  EXPECT_EQ(cut.genus, 0) << cut.log << cut.error;
  EXPECT_TRUE(contains(cut.log, "bridge between vessels at")) << cut.log;
}

TEST(FaultyLabels, OfOneLabelNarrowRingsAreClosedAndWideOnesAreTears) {
  const auto image = image_of([](const Point& p) { return bridged(p) != 0; }, {40, 20, 70}, straight);
  SurfaceSettings asked;
  asked.openings = {{"left", {{{-6 * mm, 0, 20 * mm}}, {}}}, {"right", {{{6 * mm, 0, 20 * mm}}, {}}}};
  const auto closed = make(image, asked);
  EXPECT_EQ(closed.genus, 0) << closed.log << closed.error;
  asked.tears.smallest = 2e-6;
  EXPECT_EQ(make(image, asked).genus, 1) << make(image, asked).log << make(image, asked).error;
}

}  // namespace
}  // namespace tunica::imaging
