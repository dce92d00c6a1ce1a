// HTML of pages that need no other file: reports of meshes and of cases.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tunica::drawing::page {

/// Text in which nothing is taken for markup, neither between tags nor in an attribute; always UTF-8.
std::string escaped(const std::string& text);

/// A message for a page: escaped, with what stands between backticks as code.
std::string prose(const std::string& text);

/// What the head of a page holds besides its title.
struct Head {
  /// Content security policy; that of pages without scripts lets nothing run and fetches nothing.
  std::string policy =
      "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'";
  std::string style = "";  ///< besides that of all pages
};

/// From the first character of the file to the title as a heading, and its end.
std::string begin(const std::string& title, const Head& head = {});
std::string end();
/// What stands between these two in a page, without the heading.
std::string body(const std::string& page);

std::string base64(const std::vector<std::uint8_t>& bytes);
/// "data:image/png;base64,..." for an <img>; `type`: png or svg+xml.
std::string data_url(const std::vector<std::uint8_t>& bytes, const std::string& type = "png");
/// A picture of data_url() with a line below it.
std::string picture(const std::string& url, const std::string& caption);
/// A drawing of draw_plot().
std::string drawing(const std::string& svg);

/// A row of cells; `tag`: td, or th for a head. Cells are markup.
std::string row(const std::vector<std::string>& cells, const char* tag = "td");
/// `caption`: markup, none when empty. Where scripts run (viewer/view_page.hpp) a click on a heading sorts.
std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                  const std::string& caption = "");

}  // namespace tunica::drawing::page
