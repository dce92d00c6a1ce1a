#include "tunica/mesh_io/gmsh.hpp"

#include <fmt/format.h>

#include <cstring>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "unit/mesh/check_mesh.hpp"

namespace tunica::mesh_io {

namespace {

using test::message_of;
using test::TemporaryFolder;
using tunica::test::contains;

enum class Encoding { ascii, binary, swapped };

/// Writes numbers as text or bytes.
class Sink {
 public:
  explicit Sink(Encoding encoding) : encoding_(encoding) {}
  Sink& integer(std::int32_t v) { return put(v); }
  Sink& size(std::int64_t v) { return put(v); }
  Sink& real(double v) { return put(v); }
  Sink& text(const std::string& s) {
    out_ += s;
    return *this;
  }
  const std::string& str() const { return out_; }

 private:
  template <class T>
  Sink& put(T v) {
    if (encoding_ == Encoding::ascii) return text(fmt::format("{}\n", v));
    char bytes[sizeof(T)];
    std::memcpy(bytes, &v, sizeof(T));
    if (encoding_ == Encoding::swapped) std::reverse(bytes, bytes + sizeof(T));
    out_.append(bytes, sizeof(T));
    return *this;
  }
  Encoding encoding_;
  std::string out_;
};

/// A row of cubes along x: the first is blood, the second wall, the third flap, as one mesh with shared nodes.
/// Surfaces: 1 x = 0, 2 x = 1 (blood | wall), 3 x = 2 (wall | flap), 4 x = 3, 5 all others.
struct Model {
  mesh::MeshData mesh = mesh::box(3, 1, 1, {{3, 1, 1}}, mesh::RegionKind::wall);
  std::vector<std::string> volumes = {"blood", "wall", "flap"};
  std::vector<std::string> surfaces = {"inlet", "contact", "seam", "end", "sides"};
  std::string version = "4.1";
  int tetrahedron = 4;
};

int volume_of(const Model& m, const std::array<std::int64_t, 4>& t) {
  return static_cast<int>(mesh::centroid(m.mesh.points, t)[0]) + 1;
}

/// Triangles of each surface, those inside the row taken from the volumes on both sides of it.
std::vector<std::vector<std::array<std::int64_t, 3>>> surface_triangles(const Model& m) {
  std::vector<std::vector<std::array<std::int64_t, 3>>> result(5);
  for (const auto& t : m.mesh.tetrahedra)
    for (const auto& f : mesh::tetrahedron_faces) {
      const std::array<std::int64_t, 3> nodes = {t[f[0]], t[f[1]], t[f[2]]};
      const auto c = mesh::centroid(m.mesh.points, nodes), n = mesh::testing::area_vector(m.mesh, nodes);
      const auto is = [](double a, double b) { return std::abs(a - b) < 1e-12; };
      const bool across = is(std::abs(n[0]), norm(n));
      if (across && is(c[0], 0)) result[0].push_back(nodes);
      for (int s : {1, 2})
        if (across && is(c[0], s) && n[0] > 0) result[s].push_back(nodes);
      if (across && is(c[0], 3)) result[3].push_back(nodes);
      if (is(c[1], 0) || is(c[1], 1) || is(c[2], 0) || is(c[2], 1)) result[4].push_back(nodes);
    }
  return result;
}

std::string nodes_section(const Model& m, Encoding encoding) {
  Sink s(encoding);
  const std::int64_t n = std::ssize(m.mesh.points);
  s.text("$Nodes\n").size(2).size(n + 1).size(7).size(10 * n + 7);
  s.integer(3).integer(1).integer(0).size(n);
  for (std::int64_t i = 0; i < n; ++i) s.size(10 * i + 7);  // tags with gaps
  for (const auto& p : m.mesh.points) s.real(p[0]).real(p[1]).real(p[2]);
  // A node of the geometry that no element uses, with its parameter on a curve.
  s.integer(1).integer(1).integer(1).size(1).size(10 * n + 7).real(9).real(9).real(9).real(0.5);
  return s.text("\n$EndNodes\n").str();
}

std::string elements_section(const Model& m, Encoding encoding) {
  Sink s(encoding);
  const auto surfaces = surface_triangles(m);
  std::int64_t tag = 1;
  std::int64_t elements = 1 + 3 * 6;
  for (int f = 0; f < 5; ++f) elements += m.surfaces[f].empty() ? 0 : std::ssize(surfaces[f]);
  s.text("$Elements\n").size(3 + 5 + 1).size(elements).size(1).size(1000);
  s.integer(1).integer(1).integer(1).size(1).size(tag++).size(7).size(17);  // a line
  for (int v = 1; v <= 3; ++v) {
    s.integer(3).integer(v).integer(m.tetrahedron).size(6);
    for (const auto& t : m.mesh.tetrahedra)
      if (volume_of(m, t) == v) {
        s.size(tag++);
        for (auto n : t) s.size(10 * n + 7);
      }
  }
  for (int f = 0; f < 5; ++f) {
    // Without physical group Gmsh does not save a surface.
    const bool saved = !m.surfaces[f].empty();
    s.integer(2).integer(f + 1).integer(2).size(saved ? surfaces[f].size() : 0);
    if (!saved) continue;
    for (const auto& t : surfaces[f]) {
      s.size(tag++);
      for (auto n : t) s.size(10 * n + 7);
    }
  }
  return s.text("\n$EndElements\n").str();
}

std::string msh(const Model& m, Encoding encoding) {
  Sink head(encoding);
  head.text(fmt::format("$MeshFormat\n{} {} 8\n", m.version, encoding == Encoding::ascii ? 0 : 1));
  if (encoding != Encoding::ascii) head.integer(1);
  head.text("\n$EndMeshFormat\n$PhysicalNames\n8\n");
  for (int v = 0; v < 3; ++v) head.text(fmt::format("3 {} \"{}\"\n", v + 11, m.volumes[v]));
  for (int f = 0; f < 5; ++f) head.text(fmt::format("2 {} \"{}\"\n", f + 21, m.surfaces[f]));
  head.text("$EndPhysicalNames\n$Entities\n").size(1).size(1).size(5).size(3);
  head.integer(1).real(0).real(0).real(0).size(0);
  const auto entity = [&](int tag, const std::vector<int>& physical, const std::vector<int>& bounding) {
    head.integer(tag);
    for (int d = 0; d < 6; ++d) head.real(0);
    head.size(std::ssize(physical));
    for (int p : physical) head.integer(p);
    head.size(std::ssize(bounding));
    for (int b : bounding) head.integer(b);
  };
  entity(1, {}, {1, -1});
  for (int f = 0; f < 5; ++f) entity(f + 1, m.surfaces[f].empty() ? std::vector<int>{} : std::vector<int>{f + 21}, {1});
  for (int v = 0; v < 3; ++v)
    entity(v + 1, m.volumes[v].empty() ? std::vector<int>{} : std::vector<int>{v + 11}, {1, 2});
  head.text("\n$EndEntities\n$Periodic\nskipped\n$EndPeriodic\n");
  return head.str() + nodes_section(m, encoding) + elements_section(m, encoding);
}

const GmshOptions options{
    .metres_per_unit = 0.5,
    .regions = {
        {"wall", mesh::RegionKind::wall}, {"blood", mesh::RegionKind::lumen}, {"flap", mesh::RegionKind::wall}}};

mesh::LoadedMesh read_text(const std::string& content, const GmshOptions& with = options) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "mesh.msh";
  std::ofstream(path, std::ios::binary) << content;
  return read_gmsh(path, with);
}

std::string refusal(const Model& model, const GmshOptions& with = options) {
  return message_of<InputError>([&] { read_text(msh(model, Encoding::ascii), with); });
}

}  // namespace

TEST(Gmsh, ReadsAllEncodingsAndSplitsTheInterface) {
  for (const auto encoding : {Encoding::ascii, Encoding::binary, Encoding::swapped}) {
    const auto mesh = read_text(msh({}, encoding));
    const auto& data = mesh.data;
    mesh::testing::expect_sound(data);
    ASSERT_EQ(data.regions.size(), 3u);
    EXPECT_EQ(data.regions[0].name, "wall");
    EXPECT_EQ(data.regions[1].kind, mesh::RegionKind::lumen);
    for (const auto& r : data.regions) {
      EXPECT_EQ(r.end_element - r.first_element, 6);
      EXPECT_NEAR(mesh::testing::volume(data, r), 0.125, 1e-15);
    }
    EXPECT_EQ(data.points.size(), 16u + 4u);  // the seam of wall and flap stays shared
    ASSERT_EQ(data.twins.size(), 4u);
    for (auto [wall, lumen] : data.twins) {
      EXPECT_GE(wall, 16);
      EXPECT_EQ(norm(data.points[wall] - data.points[lumen]), 0.0);
      EXPECT_NEAR(data.points[wall][0], 0.5, 1e-15);
    }
  }
}

TEST(Gmsh, NamesFacesByRegionWhereASurfaceBoundsSeveral) {
  const auto mesh = read_text(msh({}, Encoding::binary));
  std::map<std::string, std::pair<std::string, std::size_t>> faces;
  for (const auto& f : mesh.data.faces) faces[f.name] = {mesh.data.regions[f.region].name, f.triangles.size()};
  const std::map<std::string, std::pair<std::string, std::size_t>> expected = {
      {"inlet", {"blood", 2}},    {"blood_contact", {"blood", 2}}, {"wall_contact", {"wall", 2}},
      {"end", {"flap", 2}},       {"blood_sides", {"blood", 8}},   {"wall_sides", {"wall", 8}},
      {"flap_sides", {"flap", 8}}};
  EXPECT_EQ(faces, expected);
  bool told = false;
  for (const auto& line : mesh.report) told |= contains(line, "physical surface seam: 2 triangles inside the mesh");
  EXPECT_TRUE(told);
}

TEST(Gmsh, NamesAnInterfaceWithoutPhysicalSurface) {
  Model model;
  model.surfaces[1] = "";
  const auto mesh = read_text(msh(model, Encoding::ascii));
  mesh::testing::expect_sound(mesh.data);
  EXPECT_EQ(mesh::testing::face(mesh.data, "blood_interface").triangles.size(), 2u);
  EXPECT_EQ(mesh::testing::face(mesh.data, "wall_interface").triangles.size(), 2u);
}

TEST(Gmsh, RefusesWhatIsNotNamed) {
  Model model;
  model.surfaces[0] = "in*";
  model.surfaces[3] = "END/2";
  EXPECT_TRUE(contains(refusal(model), "the name 'in*' of a face has the character '*'")) << refusal(model);
  EXPECT_TRUE(contains(refusal(model), "the name 'END/2' of a face has the character '/'")) << refusal(model);
  model = {};
  model.surfaces[3] = "";
  EXPECT_TRUE(contains(refusal(model), "2 of 32 boundary triangles lie in no named face: (1.5, ")) << refusal(model);
  model = {};
  model.volumes[2] = "";
  EXPECT_TRUE(contains(refusal(model), "elementary volume 3 is in 0 physical groups")) << refusal(model);
  auto fewer = options;
  fewer.regions.pop_back();
  EXPECT_TRUE(contains(refusal({}, fewer), "physical volume flap is not declared; declared are: wall, blood"));
  auto more = options;
  more.regions.push_back({"stent", mesh::RegionKind::wall});
  EXPECT_TRUE(contains(refusal({}, more), "no tetrahedra in a physical volume called stent"));
  auto lumens = options;
  lumens.regions[0].kind = mesh::RegionKind::lumen;
  EXPECT_TRUE(contains(refusal({}, lumens), "2 lumen regions"));
}

TEST(Gmsh, RefusesInvertedElementsAndOtherFiles) {
  Model model;
  std::swap(model.mesh.tetrahedra[4][0], model.mesh.tetrahedra[4][1]);
  EXPECT_TRUE(contains(refusal(model), "1 of 18 elements are inverted")) << refusal(model);
  model = {};
  model.version = "2.2";
  EXPECT_TRUE(contains(refusal(model), "MSH version 2.2, only 4.1 is read"));
  model = {};
  model.tetrahedron = 11;
  EXPECT_TRUE(contains(refusal(model), "dimension 3 and Gmsh type 11")) << refusal(model);
  EXPECT_THROW(read_gmsh("/nonexistent.msh", options), InputError);
}

TEST(Gmsh, RefusesDamagedFilesWhereverTheyEnd) {
  for (const auto encoding : {Encoding::ascii, Encoding::binary}) {
    const auto whole = msh({}, encoding);
    for (std::size_t length = 0; length + 2 < whole.size(); length += 97)
      EXPECT_THROW(read_text(whole.substr(0, length)), InputError) << length;
  }
}

// --- files that lie about themselves --------------------------------------------------------------------------------

namespace {

std::string refusal_of_text(const std::string& content, const GmshOptions& with = options) {
  return message_of<InputError>([&] { read_text(content, with); });
}

/// The text with the first `from` behind `after` replaced.
std::string with(std::string text, const std::string& after, const std::string& from, const std::string& to) {
  const auto place = text.find(from, text.find(after));
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

/// Takes the section out of the text.
std::string cut(std::string& text, const std::string& section) {
  const auto begin = text.find("$" + section), end = text.find("$End" + section) + 5 + section.size();
  const auto part = text.substr(begin, end - begin);
  text.erase(begin, end - begin);
  return part;
}

/// $ElementData `e1` of three components, for each tetrahedron ten times its tag.
std::string element_data(Encoding encoding, std::int64_t count, int components = 3) {
  Sink s(encoding);
  s.text(fmt::format("\n$ElementData\n1\n\"e1\"\n1\n0\n3\n0\n{}\n{}\n", components, count));
  for (std::int32_t tag = 2; tag < 20; ++tag) {
    s.integer(tag);
    for (int c = 0; c < 3; ++c) s.real(10 * tag);
  }
  return s.text("\n$EndElementData\n").str();
}

GmshOptions with_e1() {
  auto result = options;
  result.fields = {"e1"};
  return result;
}

}  // namespace

TEST(Gmsh, ReadsSectionsInAnyOrder) {
  for (const auto encoding : {Encoding::ascii, Encoding::binary}) {
    auto text = msh({}, encoding);
    const auto expected = read_text(text + element_data(encoding, 18), with_e1()).data;
    const auto elements = cut(text, "Elements"), nodes = cut(text, "Nodes"), names = cut(text, "PhysicalNames");
    for (const auto& order :
         {element_data(encoding, 18) + elements + nodes, elements + element_data(encoding, 18) + nodes,
          nodes + element_data(encoding, 18) + elements}) {
      const auto data = read_text(text + order + "\n" + names, with_e1()).data;
      EXPECT_EQ(data.tetrahedra, expected.tetrahedra);
      ASSERT_EQ(data.fields.size(), 1u);
      EXPECT_EQ(data.fields[0].values, expected.fields[0].values);
    }
    // The wall, of which the file says the elements 8 to 13, comes first in the mesh.
    EXPECT_EQ(expected.fields[0].values[0], 80);
  }
}

TEST(Gmsh, RefusesSectionsThatAreThereTwiceOrNotAtAll) {
  const auto text = msh({}, Encoding::ascii);
  for (const std::string section : {"PhysicalNames", "Entities", "Nodes", "Elements"}) {
    auto rest = text;
    const auto part = cut(rest, section);
    EXPECT_NE(refusal_of_text(rest), "") << section;
    EXPECT_TRUE(contains(refusal_of_text(text + part), "section $" + section + " is there twice")) << section;
  }
  EXPECT_TRUE(contains(refusal_of_text(""), "is empty"));
  EXPECT_TRUE(contains(refusal_of_text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"), "no tetrahedra"));
}

TEST(Gmsh, RefusesCountsThatTheFileHasNoRoomFor) {
  const auto text = msh({}, Encoding::ascii);
  for (const char* count : {"1000000", "9000000000000000000", "-5"}) {
    for (const std::string section : {"PhysicalNames", "Entities", "Nodes", "Elements"}) {
      const auto line = text.find('\n', text.find("$" + section)) + 1;
      auto changed = text;
      changed.replace(line, text.find('\n', line) - line, count);
      const auto why = refusal_of_text(changed);
      EXPECT_TRUE(contains(why, "section $" + section + " is damaged")) << section << " " << count << ": " << why;
    }
  }
  EXPECT_TRUE(contains(refusal_of_text(text + element_data(Encoding::ascii, 1LL << 60), with_e1()), "does not fit"));
  EXPECT_TRUE(contains(refusal_of_text(text + element_data(Encoding::ascii, 18, -3), with_e1()), "components -3"));
  EXPECT_TRUE(contains(refusal_of_text(text + element_data(Encoding::ascii, 12), with_e1()), "holds more, or less"));
  // One element too many in the head of the section, one too few.
  EXPECT_TRUE(contains(refusal_of_text(with(text, "$Elements", "\n9\n", "\n10\n")), "section $Elements is damaged"));
}

TEST(Gmsh, RefusesNumbersBeyondTheirRange) {
  const auto text = msh({}, Encoding::ascii);
  for (const char* number : {"-2147483648", "2147483648", "99999999999999999999"}) {
    const auto why = refusal_of_text(with(text, "$Entities", "\n11\n", fmt::format("\n{}\n", number)));
    EXPECT_TRUE(contains(why, "section $Entities is damaged")) << number << why;
  }
  EXPECT_TRUE(contains(refusal_of_text(with(text, "$PhysicalNames", "3 11", "3 -2147483648")), "is out of range"));
  // A group of the other orientation is the same group.
  EXPECT_NO_THROW(read_text(with(text, "$Entities", "\n11\n", "\n-11\n")));
  EXPECT_TRUE(contains(refusal_of_text(with(text, "$Nodes", "\n3\n1\n0\n", "\n-3\n1\n0\n")), "the dimension -3"));
  EXPECT_TRUE(contains(refusal_of_text(with(text, "$Nodes", "\n3\n1\n0\n", "\n7\n1\n0\n")), "the dimension 7"));
  for (const char* value : {"nan", "inf", "-inf", "1e400"}) {
    const auto why = refusal_of_text(with(text, "$Nodes", "\n0.5\n", fmt::format("\n{}\n", value)));
    EXPECT_NE(why.find(value == std::string("1e400") ? "is damaged" : ""), std::string::npos) << why;
  }
}

TEST(Gmsh, RefusesElementDataOfElementsWithTheSameNumber) {
  auto text = msh({}, Encoding::ascii);
  text = with(text, "\n3\n2\n4\n6\n", "\n8\n", "\n2\n");
  EXPECT_NO_THROW(read_text(text));
  EXPECT_TRUE(contains(refusal_of_text(text + element_data(Encoding::ascii, 18), with_e1()),
                       "several elements have this number"));
}

// Whatever single byte is wrong, the reader must come to an end of its own; sanitizers see the rest.
TEST(Gmsh, SurvivesAnyWrongByte) {
  for (const auto encoding : {Encoding::ascii, Encoding::binary}) {
    const auto whole = msh({}, encoding) + element_data(encoding, 18);
    for (std::size_t i = 0; i < whole.size(); i += 151)
      for (const char byte : {'\0', '-', '9', '\xff'}) {
        auto changed = whole;
        changed[i] = byte;
        try {
          read_text(changed, with_e1());
        } catch (const InputError& error) {
          EXPECT_NE(std::string(error.what()), "");
        }
      }
  }
}

}  // namespace tunica::mesh_io
