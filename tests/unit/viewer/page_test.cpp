#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/viewer/view_page.hpp"

namespace tunica::viewer {
namespace {

using nlohmann::json;

/// One triangle whose corners move and whose values are known.
Beat small_beat(const std::string& title) {
  Beat beat;
  beat.title = title;
  beat.times = {0, 0.25, 0.5, 0.75};
  Body body;
  body.name = "surface";
  body.points = {{{0, 0, 0}}, {{0.01, 0, 0}}, {{0, 0.02, 0}}};
  body.triangles = {{0, 1, 2}};
  body.groups = {{"inner", "wall", 0, 1}};
  Quantity pressure{"pressure", "mmHg", "blood", 1, 0, 3, {}}, displacement{"displacement", "mm", "wall", 3, 0, 3, {}};
  for (const double t : beat.times) {
    const auto s = static_cast<float>(std::sin(2 * M_PI * t));
    pressure.frames.push_back({80 + 40 * s, 90 + 30 * s, 100 - 20 * s});
    displacement.frames.push_back({s, 0, 0, s, 0, 0, s, 0, -s});
  }
  body.quantities = {pressure, displacement};
  beat.bodies = {body};
  beat.lines = {{"family 1",
                 "inner",
                 "wall",
                 0.001,
                 {{{0.009, 0.001, 0}}, {{0.001, 0.018, 0}}},
                 {{{1, 0, 0}}, {{0, -0.6, 0.8}}}}};
  return beat;
}

std::vector<unsigned char> inflated(const std::string& base64) {
  std::vector<unsigned char> packed;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    const auto at = std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    if (at == std::string::npos) break;
    bits = (bits << 6) | static_cast<std::uint32_t>(at);
    count += 6;
    if (count >= 8) packed.push_back(static_cast<unsigned char>(bits >> (count -= 8)));
  }
  std::vector<unsigned char> bytes(100000);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, packed.data(), packed.size()), Z_OK);
  bytes.resize(size);
  return bytes;
}

/// As unpack() in beat.js.
std::vector<std::int32_t> unpacked(const std::vector<unsigned char>& bytes, const json& place, bool is_signed) {
  const auto o = place["o"].get<std::size_t>(), n = place["n"].get<std::size_t>();
  const int w = place["w"];
  std::vector<std::int32_t> values;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t folded = 0;
    for (int b = 0; b < w; ++b)
      folded |= static_cast<std::uint32_t>(bytes[o + static_cast<std::size_t>(b) * n + i]) << (8 * b);
    before += (folded >> 1) ^ (~(folded & 1) + 1);
    if (w < 4) before &= (1U << (8 * w)) - 1;
    const int shift = is_signed ? 32 - 8 * w : 0;
    values.push_back(static_cast<std::int32_t>(before << shift) >> shift);
  }
  return values;
}

TEST(Pack, IsReadAgainToItsDeviation) {
  const Beat beat = small_beat("Beat");
  const auto packed = pack(beat, {.tolerance = 0.001});
  const auto head = json::parse(packed.head);
  const auto bytes = inflated(packed.data);
  const auto& body = head["bodies"][0];
  const auto places = unpacked(bytes, body["points"], false);
  const double step = head["step"];
  const auto order_of = [&](std::size_t i) {  // points may have changed places
    const double x = step * places[i], y = step * places[3 + i];
    return x > 5 ? 1 : y > 5 ? 2 : 0;
  };
  const auto& q = body["quantities"][0];
  ASSERT_EQ(q["name"], "pressure");
  const auto mean = unpacked(bytes, q["mean"], true);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      double value = q["ms"].get<double>() * mean[i];
      for (const auto& mode : q["modes"])
        value += mode["s"].get<double>() * mode["c"][t].get<double>() * unpacked(bytes, mode["v"], true)[i];
      EXPECT_NEAR(value, beat.bodies[0].quantities[0].frames[t][static_cast<std::size_t>(order_of(i))],
                  0.001 * 80 + 1e-3);
    }
  const auto& lines = head["lines"][0];
  EXPECT_EQ(lines["region"], "wall");
  const auto middles = unpacked(bytes, lines["places"], false), along = unpacked(bytes, lines["directions"], true),
             points = unpacked(bytes, lines["points"], false);
  EXPECT_NEAR(step * middles[0], 9, step);  // x of the first line [mm]
  EXPECT_NEAR(step * middles[3], 18, step);
  EXPECT_NEAR(along[3] / 127.0, -0.6, 0.005);
  EXPECT_EQ(order_of(static_cast<std::size_t>(points[0])), 1) << "the point that is nearest";
  EXPECT_EQ(order_of(static_cast<std::size_t>(points[1])), 2);
  EXPECT_EQ(packed.quantities[0].modes, 1U);
  EXPECT_LE(packed.quantities[0].compression.most, 0.001);
}

TEST(Pack, RefusesWhatIsNotFinite) {
  Beat beat = small_beat("Beat");
  beat.bodies[0].quantities[0].frames[1][0] = NAN;
  try {
    pack(beat, {});
    FAIL();
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("pressure"), std::string::npos);
  }
}

TEST(ViewPage, RunsItsOwnScriptsAlone) {
  const std::string hostile = "</script><script>alert(1)</script>";
  Beat beat = small_beat(hostile);
  beat.labels = {{hostile, "tear", {}}};
  const std::vector<Plot> plots = {{hostile, "time [s]", "flow [ml/s]", true, {{hostile, {0, 1}, {1, 2}, 0}}}};
  const PackedBeat packed = pack(beat, {});
  const std::string page = begin_page(hostile) + view() + plot(plots, 0, "flow") + end_page(plots, &packed);
  EXPECT_EQ(page.find(hostile), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'; script-src 'sha256-"), std::string::npos);
  EXPECT_EQ(page.find("'unsafe-eval'"), std::string::npos);
  std::size_t scripts = 0;  // elements begin a line; three.js has the word within it
  for (std::size_t at = 0; (at = page.find("\n<script", at)) != std::string::npos; ++at) {
    ++scripts;
    EXPECT_EQ(page.substr(at, page.find('>', at) - at).find("src="), std::string::npos);
  }
  EXPECT_EQ(scripts, 3U + 6U);                                     // data; three.js, four of the viewer, the plots
  EXPECT_GT(page.find("id=\"beat-data\""), page.find("<figure"));  // what is read by people stands before it
}

}  // namespace
}  // namespace tunica::viewer
