// The section `compare` of a case file.
#pragma once

#include <map>
#include <string>

#include "tunica/config/schema.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {

/// What takes the place of the wall's materials.
struct ComparedLaw {
  wall::LawParameters material;
  std::map<std::string, wall::RegionMaterial> regions;

  static config::Schema<ComparedLaw> schema() {
    return config::Schema<ComparedLaw>("compared_law", "Materials of the wall in a comparison.")
        .section("material", &ComparedLaw::material, wall::law_schema(), "Law of the wall and its parameters")
        .map("regions", &ComparedLaw::regions, wall::RegionMaterial::schema(),
             "Regions with a material of their own, by name")
        .by_default();
  }
};

}  // namespace tunica::case_file
