// Scripts and style of the viewer, and three.js, as they are built into the program (cmake/embed.cpp).
#pragma once

#include <string_view>

namespace tunica::viewer {

struct Asset {
  std::string_view text;
  std::string_view sha256;  ///< of the text, hexadecimal
};

namespace assets {
Asset three();  ///< three.js (MIT), of the package libjs-three
Asset beat();
Asset scene();
Asset still();
Asset panel();
Asset plots();
Asset markup();  ///< of the viewer within a page
Asset style();
}  // namespace assets

}  // namespace tunica::viewer
