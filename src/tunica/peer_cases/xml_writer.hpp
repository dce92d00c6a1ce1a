// The other way round: a tree of keys as the text of a solver.xml.
#pragma once

#include <string>

#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

/// Adds a key with its value to a section.
void add_key(Entry& section, std::string key, std::string value);
/// Adds a section; the reference holds until the next one is added beside it.
Entry& add_section(Entry& section, std::string key, std::string label = "");

/// The text that read_xml() reads back as that tree.
std::string xml_text(const Entry& root);

}  // namespace tunica::peer_cases
