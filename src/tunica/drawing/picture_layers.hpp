// Data sets on their way into a picture: read, moved, cut, skinned, with the values that colour them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tunica/drawing/picture.hpp"

class vtkPointSet;
class vtkPolyData;

namespace tunica::drawing {

struct Layer {
  std::string file;
  std::shared_ptr<vtkPointSet> data;
  std::shared_ptr<vtkPolyData> surface;
  bool coloured = false;
  std::string array = {};      ///< full name of what it is coloured by
  bool whole_numbers = false;  ///< that array is of an integer type
  bool lines = false;          ///< streamlines, which are drawn as tubes
};

/// The files with the values that colour them as active scalars; streamlines as a layer of their own. Throws
/// InputError: files that do not read, arrays that no file has (with those that exist), a plane that leaves nothing.
std::vector<Layer> make_layers(const std::vector<std::string>& files, const PictureOptions& options);

/// Finite values of all coloured layers, in the order of the files.
std::vector<double> values_in_sight(const std::vector<Layer>& layers);

/// Name of the cell array for `options.lines` in the skin of a layer; empty where it has none.
std::string lines_array(const Layer& layer, const PictureOptions& options);

}  // namespace tunica::drawing
