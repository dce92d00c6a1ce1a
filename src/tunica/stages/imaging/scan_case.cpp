#include "tunica/stages/imaging/scan_case.hpp"

#include <fmt/format.h>

#include "tunica/files/outputs.hpp"
#include "tunica/imaging/synthetic_scan.hpp"

namespace tunica::stages {

config::Schema<ScanCase> ScanCase::schema() {
  config::Schema<ScanCase> schema("tunica synthesise", "File of `tunica synthesise`, in YAML like a case file.");
  schema.section("parametric", &ScanCase::parametric, geometry::ParametricDissection::schema(), "The dissection")
      .by_default();
  config::Schema<imaging::ScanSettings> scan("scan", "How the dissection is imaged and segmented.");
  imaging::ScanSettings::add_to(scan);
  schema.section("scan", &ScanCase::scan, scan, "Scanner and segmentation").by_default();
  schema.path("output", &ScanCase::output,
              "The labelled image, .nrrd, .nhdr, .mha, .mhd, .nii or .nii.gz, relative to the folder of this file");
  return schema;
}

config::Parsed<ScanCase> read_scan_case(const std::filesystem::path& file) {
  return config::parse_file(ScanCase::schema(), file);
}

std::string scan_to_file(const ScanCase& scan_case, bool overwrite) {
  if (!overwrite && std::filesystem::exists(scan_case.output))
    throw InputError(scan_case.output.string(), "is there already", "give --overwrite, or another `output`");
  if (const auto folder = scan_case.output.parent_path(); !folder.empty()) files::make_folder(folder);
  files::try_output(scan_case.output);
  const geometry::DissectionModel model(*scan_case.parametric);
  imaging::write_label_image(scan(model, scan_case.scan), scan_case.output);
  std::string text =
      fmt::format("geometry:\n  image:\n    file: {}\n    true_lumen: {}\n    false_lumen: {}\n{}    openings:\n",
                  scan_case.output.filename().string(), imaging::scan_true_lumen, imaging::scan_false_lumen,
                  model.has_thrombus() ? fmt::format("    thrombus: {}\n", imaging::scan_thrombus) : "");
  for (const auto& o : model.openings())
    text += fmt::format("      {}: {{centre: [{:.2f} mm, {:.2f} mm, {:.2f} mm]}}\n", o.name, 1e3 * o.centre[0],
                        1e3 * o.centre[1], 1e3 * o.centre[2]);
  return text;
}

}  // namespace tunica::stages
