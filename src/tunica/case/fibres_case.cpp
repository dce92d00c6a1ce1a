#include "tunica/case/fibres_case.hpp"

#include "tunica/case/case_text.hpp"

namespace tunica::case_file {

namespace {

using config::Problems;
using config::Schema;

void check_fibres_case(const FibresCase& c, Problems& problems) {
  if (!c.meshes.has_wall()) problems.add("meshes", "has no wall", "give the mesh of a wall");
  const bool joined = c.meshes.has_lumen() && c.meshes.interface;
  if (!c.meshes.interface && c.inner.empty())
    problems.add("inner", "is missing, and `meshes.interface` too",
                 "name the faces of the wall towards the lumen, or the interface of wall and lumen");
  if (c.meshes.interface && !c.inner.empty())
    problems.add("inner", "is given, but `meshes.interface` says it already", "remove it");
  if (c.frames.domain == frames::Domain::lumen_and_wall && !joined)
    problems.add("domain", "is lumen_and_wall, but there is no lumen joined to the wall",
                 "give `meshes.lumen` and `meshes.interface`, or write `domain: wall`");
  if (c.tears && !joined)
    problems.add("tears", "is given, but there is no lumen joined to the wall",
                 "give `meshes.lumen` and `meshes.interface`, or remove it");
  if (c.inlet.empty()) problems.add("inlet", "names no face", "name the ring of the wall where blood enters");
}

FibresCase parse(const std::string& yaml, const std::filesystem::path& file, bool check_files,
                 std::vector<Problem>* warnings) {
  const config::Origin origin{.name = file.string(), .folder = file.parent_path(), .check_files = check_files};
  auto parsed = config::parse_text(FibresCase::schema(), yaml, origin);
  if (warnings) *warnings = std::move(parsed.warnings);
  return std::move(parsed.value);
}

}  // namespace

Schema<FibresCase> FibresCase::schema() {
  return Schema<FibresCase>("tunica fibres", "File of `tunica fibres`, in YAML like a case file.")
      .text("title", &FibresCase::title, "Free text for logs and reports")
      .by_default()
      .section("meshes", &FibresCase::meshes, MeshSettings::schema(), "As in a case file; `tunica mesh` writes it")
      .include([](FibresCase& c) -> FibreSettings& { return c; }, FibreSettings::schema())
      .check(check_fibres_case);
}

config::Parsed<FibresCase> read_fibres_case(const std::filesystem::path& file) {
  return read_fibres_case(config::read_text(file), file);
}

config::Parsed<FibresCase> read_fibres_case(const std::string& yaml, const std::filesystem::path& file) {
  config::Parsed<FibresCase> parsed;
  parsed.value = parse(yaml, file, true, &parsed.warnings);
  return parsed;
}

FibresCase parse_fibres_case(const std::string& yaml, const std::filesystem::path& file) {
  return parse(yaml, file, false, nullptr);
}

}  // namespace tunica::case_file
