// Names that a case file gives to parts of itself.
#pragma once

#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/mesh/names.hpp"

namespace tunica::case_file {

/// The keys of the map at `key` become names of files, of folders or of columns.
template <class Map>
void check_keys(const std::string& key, const Map& map, const std::string& what, config::Problems& problems) {
  std::vector<mesh::PlacedName> names;
  for (const auto& [name, value] : map) names.push_back({name, key + "." + name});
  for (auto& problem : mesh::check_names(names, what)) problems.errors.push_back(std::move(problem));
}

}  // namespace tunica::case_file
