#include "tunica/drawing/canvas.hpp"

#include <gtest/gtest.h>

#include "tunica/drawing/page.hpp"

namespace tunica::drawing {
namespace {

TEST(Canvas, DrawsWhatIsInFront) {
  Canvas canvas(40, 40, {{{0, 0, 0}}, {{0, 0, 1}}, {{0, 1, 0}}, 4});
  const auto square = [&](double z, double reach, Colour colour) {
    const geometry::Point a{{-reach, -reach, z}}, b{{reach, -reach, z}}, c{{reach, reach, z}}, d{{-reach, reach, z}};
    canvas.add({a, b, c}, colour);
    canvas.add({a, c, d}, colour);
  };
  square(0, 1, {200, 0, 0});
  const auto red = canvas.png();
  square(-1, 1, {0, 200, 0});  // hidden
  EXPECT_EQ(canvas.png(), red);
  square(1, 0.5, {0, 0, 200});
  EXPECT_NE(canvas.png(), red);
  EXPECT_EQ(page::data_url({'P', 'N', 'G', '!'}), "data:image/png;base64,UE5HIQ==");
}

}  // namespace
}  // namespace tunica::drawing
