// SVG documents as PNG images.
#pragma once

#include <string>

namespace tunica::drawing {

/// Renders an SVG document of a width and height in pixels to a PNG file, on white, with `scale` pixels for one of the
/// document. Throws InputError if the file cannot be written, std::invalid_argument if the document is not SVG.
void write_png(const std::string& file, const std::string& svg, int scale);

}  // namespace tunica::drawing
