#include "tunica/mesh_io/vtk_files.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstring>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::mesh_io {

namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::slurp;
using test::TemporaryFolder;
using tunica::test::contains;

enum class Data { ascii, binary, appended_raw, appended_base64 };
enum class Packing { none, zlib, lz4, lzma };

/// How a file is written. With small blocks the arrays below take several of them.
struct Form {
  Data data = Data::ascii;
  Packing packing = Packing::none;
  bool big_endian = false, long_header = false;
};

template <class Writer>
void set_form(Writer* writer, const Form& form) {
  if (form.data == Data::ascii) writer->SetDataModeToAscii();
  if (form.data == Data::binary) writer->SetDataModeToBinary();
  if (form.data == Data::appended_raw || form.data == Data::appended_base64) writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(form.data == Data::appended_base64);
  if (form.packing == Packing::none) writer->SetCompressorTypeToNone();
  if (form.packing == Packing::zlib) writer->SetCompressorTypeToZLib();
  if (form.packing == Packing::lz4) writer->SetCompressorTypeToLZ4();
  if (form.packing == Packing::lzma) writer->SetCompressorTypeToLZMA();
  writer->SetBlockSize(64);
  if (form.big_endian) writer->SetByteOrderToBigEndian();
  form.long_header ? writer->SetHeaderTypeToUInt64() : writer->SetHeaderTypeToUInt32();
}

std::vector<Form> all_forms() {
  std::vector<Form> forms = {{}, {.big_endian = true}};
  for (const auto data : {Data::binary, Data::appended_raw, Data::appended_base64})
    for (const auto packing : {Packing::none, Packing::zlib, Packing::lz4, Packing::lzma})
      for (const bool big : {false, true})
        for (const bool wide : {false, true}) forms.push_back({data, packing, big, wide});
  return forms;
}

constexpr int rows = 20;

vtkNew<vtkPoints> strip_points() {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < rows + 3; ++i) points->InsertNextPoint(0.1 * i, i % 2, i % 3);
  return points;
}

/// A row of tetrahedra with the integer array GlobalNodeID and the cell array `size`.
void write_volume(const fs::path& path, const Form& form) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(strip_points());
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> size;
  size->SetName("size");
  for (vtkIdType i = 0; i < rows; ++i) {
    const vtkIdType corners[4] = {i, i + 1, i + 2, i + 3};
    cells->InsertNextCell(4, corners);
    size->InsertNextValue(0.5 * static_cast<double>(i));
  }
  grid->SetCells(VTK_TETRA, cells);
  grid->GetCellData()->AddArray(size);
  vtkNew<vtkIntArray> ids;
  ids->SetName("GlobalNodeID");
  for (int i = 0; i < rows + 3; ++i) ids->InsertNextValue(i + 1);
  grid->GetPointData()->AddArray(ids);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  set_form(writer.Get(), form);
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  ASSERT_EQ(writer->Write(), 1);
}

std::string written(const Form& form) {
  const TemporaryFolder folder;
  write_volume(folder.path() / "a.vtu", form);
  return slurp(folder.path() / "a.vtu");
}

/// What refuses this content; "accepted" when nothing does. Nothing may be printed meanwhile.
std::string refusal(const std::string& content, bool surface = false) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.vtk";
  std::ofstream(path, std::ios::binary) << content;
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string text = "accepted";
  try {
    surface ? read_vtk_surface(path) : read_vtk_volume(path, {"size"});
  } catch (const InputError& error) {
    text = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << text;
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << text;
  return text;
}

void expect_refusal(const std::string& content, const std::string& why, bool surface = false) {
  const auto text = refusal(content, surface);
  EXPECT_TRUE(contains(text, why)) << text.substr(0, 600) << "\nexpected: " << why;
}

std::string replaced(std::string text, const std::string& from, const std::string& to, std::size_t after = 0) {
  const auto at = text.find(from, after);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// One tetrahedron or triangle in text, the arrays of its cells as given.
std::string small_volume(const std::string& connectivity = "0 1 2 3", const std::string& offsets = "4",
                         const std::string& types = "10",
                         const std::string& counts = R"(NumberOfPoints="4" NumberOfCells="1")",
                         const std::string& offset_type = "Int64") {
  return R"(<?xml version="1.0"?><!-- by hand --><VTKFile type="UnstructuredGrid" version="0.1" byte_order='LittleEndian'>
<UnstructuredGrid><Piece )" +
         counts + R"(>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<CellData><DataArray type="Float32" Name="size" format="ascii">2</DataArray></CellData>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">)" +
         connectivity + R"(</DataArray>
<DataArray type=")" +
         offset_type + R"(" Name="offsets" format="ascii">)" + offsets + R"(</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">)" +
         types + "</DataArray></Cells>\n</Piece></UnstructuredGrid></VTKFile>\n";
}

}  // namespace

TEST(VtkFiles, ReadsEveryForm) {
  for (const auto& form : all_forms()) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.vtu";
    write_volume(path, form);
    const auto cells = read_vtk_volume(path, {"size"});
    ASSERT_EQ(cells.types.size(), static_cast<std::size_t>(rows));
    EXPECT_EQ(cells.connectivity.back(), rows + 2);
    EXPECT_EQ(cells.offsets.back(), 4 * rows);
    EXPECT_EQ(cells.global_node_ids[4], 5);
    EXPECT_EQ(cells.fields[0].values[3], 1.5);
    EXPECT_DOUBLE_EQ(cells.points[7][0], 0.7);
  }
}

TEST(VtkFiles, RefusesFilesThatEndTooEarlyWhereverTheyDo) {
  for (const Form& form :
       {Form{}, Form{.data = Data::binary}, Form{.data = Data::binary, .packing = Packing::zlib},
        Form{.data = Data::appended_raw}, Form{.data = Data::appended_base64, .packing = Packing::lz4}}) {
    const auto whole = written(form);
    const auto arrays_end = whole.find("<AppendedData");
    // Behind the last array only tags follow, which VTK does not read.
    const auto end = arrays_end == std::string::npos ? whole.find("</VTKFile") : whole.find("</AppendedData") - 8;
    for (std::size_t length = 0; length < end; length += 89)
      EXPECT_NE(refusal(whole.substr(0, length)), "accepted") << length << " of " << whole.size();
  }
}

TEST(VtkFiles, RefusesNumbersThatTheFileHasNoRoomFor) {
  for (const Form& form :
       {Form{}, Form{.data = Data::binary}, Form{.data = Data::appended_raw, .packing = Packing::zlib}}) {
    const auto whole = written(form);
    for (const char* key : {"NumberOfPoints=\"23\"", "NumberOfCells=\"20\""})
      for (const char* value : {"24", "1000", "1000000000", "1000000000000", "1000000000000000000",
                                "2305843009213693953", "99999999999999999999", "-1", "1e18", "x", ""}) {
        const std::string text = key;
        const auto why = refusal(replaced(whole, text, text.substr(0, text.find('"') + 1) + value + "\""));
        EXPECT_TRUE(contains(why, "are needed") || contains(why, "is not possible in a file of"))
            << value << ": " << why;
      }
  }
  for (const char* components : {"0", "-3", "1000000000", "4"})
    EXPECT_NE(refusal(replaced(written({}), "NumberOfComponents=\"3\"",
                               fmt::format("NumberOfComponents=\"{}\"", components))),
              "accepted")
        << components;
}

TEST(VtkFiles, RefusesOffsetsAndCornersOutOfRange) {
  EXPECT_EQ(refusal(small_volume()), "accepted");
  for (const char* offset : {"5", "1000000000000", "2305843009213693956", "4611686018427387904"})
    EXPECT_NE(refusal(small_volume("0 1 2 3", offset)), "accepted") << offset;
  expect_refusal(small_volume("0 1 2 3", "-4"), "negative");
  expect_refusal(small_volume("0 1 2 3", "x"), "the last of the offsets cannot be read");
  expect_refusal(small_volume("0 1 2 3", ""), "array offsets of <Cells>: 0 values are there, 1 are needed");
  for (const char* type : {"UInt64", "Float64", "String", "Bit", "Int63", ""})
    expect_refusal(small_volume("0 1 2 3", "4", "10", R"(NumberOfPoints="4" NumberOfCells="1")", type), "type");
  for (const char* corner : {"4", "-1", "9000000000000000000"})
    expect_refusal(small_volume(fmt::format("0 1 2 {}", corner)), "but there are points 0 to 3");
  expect_refusal(small_volume("0 1 2"), "3 values are there, 4 are needed");
  expect_refusal(small_volume("0 1 2 3", "4", ""), "array types of <Cells>");
}

TEST(VtkFiles, RefusesWhatLacksAnArrayOrHasItTwice) {
  const auto whole = small_volume();
  for (const char* name : {"connectivity", "offsets", "types"}) {
    const auto other = replaced(whole, fmt::format("Name=\"{}\"", name), "Name=\"other\"");
    expect_refusal(other, fmt::format("<Cells> has no array {}", name));
  }
  expect_refusal(replaced(whole, "<DataArray type=\"Float64\"", "<Other type=\"Float64\""), "");
  expect_refusal(replaced(whole, "Name=\"types\"", "Name=\"offsets\""), "<Cells> has its array offsets twice");
  expect_refusal(replaced(whole, "Name=\"types\"", "Name=\"faces\""), "polyhedra");
  expect_refusal(replaced(whole, "Float32\" Name=\"size\"", "String\" Name=\"size\""), "array of type `String`");
  expect_refusal(replaced(whole, ">2<", "><"), "array size of <CellData>: 0 values are there");
  // What is not asked for may be as it likes.
  EXPECT_EQ(refusal(replaced(whole, "<CellData>",
                             "<CellData><DataArray type=\"Int8\" Name=\"z\" format=\"ascii\"></DataArray>")),
            "accepted");
}

TEST(VtkFiles, RefusesTwoArraysOfOneName) {
  for (const char* name : {"size", "GlobalNodeID"}) {
    auto content = written({});
    const auto array = content.rfind("<DataArray", content.find(fmt::format("Name=\"{}\"", name)));
    const auto end = content.find("</DataArray>", array) + 12;
    content.insert(end, content.substr(array, end - array));
    EXPECT_NE(refusal(content).find(fmt::format("has its array {} twice", name)), std::string::npos) << name;
  }
}

// VTK writes beyond the end of an array of texts when there are more of them than its head says.
TEST(VtkFiles, LeavesTextsOfTheFileAlone) {
  std::string texts;
  for (int i = 0; i < 3000; ++i) texts += "97 98 0 ";
  const std::string array = "<Array type=\"String\" Name=\"names\" NumberOfTuples=\"1\" format=\"ascii\">" + texts +
                            "</Array><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
                            "format=\"ascii\">2</DataArray>";
  EXPECT_EQ(refusal(replaced(small_volume(), "<Piece", "<FieldData>" + array + "</FieldData><Piece")), "accepted");
  const auto many = replaced(array, "TimeValue\" NumberOfTuples=\"1\"", "TimeValue\" NumberOfTuples=\"900000000\"");
  EXPECT_NE(refusal(replaced(small_volume(), "<Piece", "<FieldData>" + many + "</FieldData><Piece")), "accepted");
}

TEST(VtkFiles, AVolumeMayHaveNoCells) {
  const auto counts = R"(NumberOfPoints="4" NumberOfCells="0")";
  EXPECT_EQ(refusal(replaced(small_volume("", "", "", counts), ">2<", "><")), "accepted");
}

TEST(VtkFiles, SaysWhatKindOfFileItIsInstead) {
  expect_refusal("", "is empty; a VTK XML file of type UnstructuredGrid is needed");
  expect_refusal(" \n", "is empty");
  expect_refusal("# vtk DataFile Version 3.0\n", "is a legacy VTK file");
  expect_refusal(std::string("\0\5\26\7", 4), "is no XML file");
  expect_refusal("<html></html>", "is an XML file, but not one of VTK");
  expect_refusal(small_volume(), "holds VTK data of type `UnstructuredGrid`; a VTK XML file of type PolyData is needed",
                 true);
  expect_refusal(small_volume(), "save it from ParaView or SimVascular as .vtp", true);
  expect_refusal(replaced(small_volume(), "<!-- by hand -->", "<!DOCTYPE a [<!ENTITY b \"c\">]>"), "declaration");
  expect_refusal(replaced(small_volume(), "LittleEndian", "Sideways"), "byte_order `Sideways` is not known");
  expect_refusal(replaced(small_volume(), "version=\"0", "compressor=\"zip\" version=\"0"),
                 "compressor `zip` is not known");
  expect_refusal(replaced(small_volume(), "version=\"0", "header_type=\"UInt9\" version=\"0"), "header_type `UInt9`");
  expect_refusal(replaced(small_volume(), "<UnstructuredGrid>", "<UnstructuredGrid TimeValues=\"0 1\">"), "time steps");
  std::string nested;
  for (int i = 0; i < 100000; ++i) nested += "<a>";
  expect_refusal(replaced(small_volume(), "<Points>", nested + "<Points>"), "nested too deeply");
}

TEST(VtkFiles, RefusesTagsThatAreNone) {
  const auto whole = small_volume();
  expect_refusal(replaced(whole, "</Cells>", "</Points>"), "</Points> closes nothing");
  expect_refusal(replaced(whole, "</VTKFile>", ""), "the file ends before </VTKFile>");
  expect_refusal(replaced(whole, "NumberOfPoints=\"4\"", "NumberOfPoints=4"), "not in quotes");
  expect_refusal(replaced(whole, "NumberOfPoints=\"4\"", "NumberOfPoints"), "");
  expect_refusal(replaced(whole, "<Points>", "<Points"), "");
  expect_refusal(whole + "<more/>", "stands behind the end");
}

// Sizes of compressed blocks, as they stand in the bytes of the file.
TEST(VtkFiles, RefusesBlocksOfImpossibleSize) {
  const auto whole = written({.data = Data::appended_raw, .packing = Packing::zlib});
  const auto begin = whole.find('_', whole.find("<AppendedData")) + 1;
  for (std::size_t word = 0; word < 5; ++word)
    for (const std::uint32_t value : {0u, 1u, 0x7fffffffu, 0xffffffffu}) {
      auto changed = whole;
      std::memcpy(changed.data() + begin + 4 * word, &value, 4);
      EXPECT_NE(refusal(changed), "") << word << " " << value;
    }
}

// Whatever single byte is wrong, reading must come to an end of its own, without a word of VTK; sanitizers see the
// rest.
TEST(VtkFiles, SurvivesAnyWrongByte) {
  for (const Form& form :
       {Form{}, Form{.data = Data::binary, .packing = Packing::zlib}, Form{.data = Data::appended_raw}}) {
    const auto whole = written(form);
    for (std::size_t i = 0; i < whole.size(); i += 61)
      for (const char byte : {'\0', '9', '\xff'}) {
        auto changed = whole;
        changed[i] = byte;
        EXPECT_NE(refusal(changed), "");
      }
  }
}

TEST(VtkFiles, ReadsIdsOfAnyTypeAndTakesImpossibleOnesForNone) {
  const auto with_ids = [](const std::string& type, const std::string& ids) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.vtu";
    std::ofstream(path) << replaced(small_volume(), "<CellData>",
                                    "<PointData><DataArray type=\"" + type +
                                        "\" Name=\"GlobalNodeID\" format=\"ascii\">" + ids +
                                        "</DataArray></PointData><CellData>");
    return read_vtk_volume(path).global_node_ids;
  };
  for (const char* type : {"Int32", "Int64", "UInt32", "UInt64", "Float32", "Float64"})
    EXPECT_EQ(with_ids(type, "7 8 9 6"), (std::vector<std::int64_t>{7, 8, 9, 6})) << type;
  EXPECT_EQ(with_ids("Float64", "1e300 -1e300 2 3"), (std::vector<std::int64_t>{-1, -1, 2, 3}));
  EXPECT_EQ(with_ids("Int64", "9223372036854775807 -9223372036854775808 2 3"),
            (std::vector<std::int64_t>{-1, -1, 2, 3}));
}

TEST(VtkMessages, NothingIsPrintedWhileOneListens) {
  const auto verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  testing::internal::CaptureStderr();
  std::string text;
  {
    vtkNew<vtkXMLPolyDataWriter> writer;
    const FirstVtkMessage message(writer.Get());
    vtkNew<vtkXMLPolyDataWriter> other;  // nobody listens to it
    other->SetFileName("/nowhere/a.vtp");
    other->SetInputData(vtkNew<vtkPolyData>());
    other->Write();
    text = message.text();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(contains(text, "Error opening output file")) << text;
  EXPECT_EQ(vtkLogger::GetCurrentVerbosityCutoff(), verbosity);
}

}  // namespace tunica::mesh_io
