// How values become colours, and the key that says so.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tunica/drawing/picture.hpp"

class vtkLookupTable;
class vtkRenderer;

namespace tunica::drawing {

enum class ColourKind { even, diverging, categories };

struct ColourScale {
  ColourKind kind = ColourKind::even;
  std::array<double, 2> limits = {0.0, 1.0};
  std::vector<double> marks;  ///< round numbers within the limits, or the categories themselves
  std::string beyond;         ///< what lies outside of the limits; empty: nothing
};

/// Of all values that will be in sight, in the order in which they are drawn.
ColourScale colour_scale(std::vector<double> values, bool whole_numbers, const PictureOptions& options);

/// "velocity [cm s^-1]", as files have to write it, is "velocity [cm/s]" to readers.
std::string with_readable_unit(const std::string& name);

void fill_table(vtkLookupTable& table, const ColourScale& scale);

/// Part of the picture's width that is left of the key, and of its height that is below the title.
inline constexpr double bar_begin = 0.83, title_begin = 0.92;

/// The key at the right of the picture; `array`: what the values are called unless the options say.
void add_colour_key(vtkRenderer& frame, const ColourScale& scale, vtkLookupTable& table, const std::string& array,
                    const PictureOptions& options);

/// Above everything, smaller or in two lines when it is long.
void add_title(vtkRenderer& frame, const std::string& title, const PictureOptions& options);

}  // namespace tunica::drawing
