#include "tunica/drawing/picture_layers.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSmartPointer.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkWarpVector.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/drawing/picture_file.hpp"
#include "tunica/drawing/streamlines.hpp"

namespace tunica::drawing {
namespace {

std::string array_names(const std::vector<Layer>& layers) {
  std::set<std::string> names;
  for (const auto& layer : layers) {
    for (vtkFieldData* fields : {static_cast<vtkFieldData*>(layer.data->GetPointData()),
                                 static_cast<vtkFieldData*>(layer.data->GetCellData())})
      for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
        if (fields->GetArrayName(i)) names.insert(fields->GetArrayName(i));
  }
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// Full name of the array that `wanted` means: that name, or that name followed by a unit, "pressure" for
/// "pressure [mmHg]". Empty if there is none.
std::string full_name(vtkFieldData& fields, const std::string& wanted) {
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    const std::string name = fields.GetArrayName(i) ? fields.GetArrayName(i) : "";
    if (!wanted.empty() && (name == wanted || name.starts_with(wanted + " ["))) return name;
  }
  return "";
}

/// Keeps one reference of its own.
template <class T>
std::shared_ptr<T> kept(T* object) {
  object->Register(nullptr);
  return {object, [](T* o) { o->UnRegister(nullptr); }};
}

Layer read_layer(const std::string& file) {
  const auto data = vtkSmartPointer<vtkPointSet>::Take(read_points(file));
  if (data->GetNumberOfPoints() == 0) throw InputError(file, "holds no points", "give a file with a mesh");
  return {.file = file, .data = kept(data.Get()), .surface = nullptr};
}

/// Moves, cuts and skins the data of a layer.
void make_surface(Layer& layer, const PictureOptions& options) {
  vtkSmartPointer<vtkDataSet> data = layer.data.get();
  const std::string vector = full_name(*layer.data->GetPointData(), options.warp);
  if (!vector.empty()) {
    vtkNew<vtkWarpVector> warp;
    warp->SetInputData(data);
    warp->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vector.c_str());
    warp->SetScaleFactor(options.warp_factor);
    warp->Update();
    data = vtkDataSet::SafeDownCast(warp->GetOutputDataObject(0));
  }
  if (options.clip) {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(options.clip->origin.x);
    plane->SetNormal(options.clip->normal.x);
    vtkNew<vtkTableBasedClipDataSet> clip;
    clip->SetInputData(data);
    clip->SetClipFunction(plane);
    clip->InsideOutOn();
    clip->Update();
    data = vtkDataSet::SafeDownCast(clip->GetOutputDataObject(0));
  }
  vtkNew<vtkDataSetSurfaceFilter> skin;
  skin->SetInputData(data);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(skin->GetOutputPort());
  normals->SetFeatureAngle(40.0);
  normals->Update();
  layer.surface = kept(normals->GetOutput());
}

/// Replaces the active scalars of the surface by the wanted component or magnitude, scaled; false without the array.
bool set_scalars(Layer& layer, const PictureOptions& options) {
  vtkDataSetAttributes* fields = layer.surface->GetPointData();
  layer.array = full_name(*fields, options.array);
  if (layer.array.empty()) {
    fields = layer.surface->GetCellData();
    layer.array = full_name(*fields, options.array);
  }
  auto* source = layer.array.empty() ? nullptr : fields->GetArray(layer.array.c_str());
  if (!source) return false;
  layer.whole_numbers = source->GetDataType() != VTK_FLOAT && source->GetDataType() != VTK_DOUBLE;
  const int components = source->GetNumberOfComponents();
  if (options.component && (*options.component < 0 || *options.component >= components))
    throw InputError(layer.file, fmt::format("array '{}' has no component {}", options.array, *options.component),
                     fmt::format("choose 0 to {}", components - 1));
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("tunica_picture");
  scalars->SetNumberOfTuples(source->GetNumberOfTuples());
  for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i) {
    double value = 0.0;
    if (options.component || components == 1) {
      value = source->GetComponent(i, options.component.value_or(0));
    } else {
      for (int c = 0; c < components; ++c) value += source->GetComponent(i, c) * source->GetComponent(i, c);
      value = sqrt(value);
    }
    scalars->SetValue(i, options.scale * value);
  }
  // Only one of the two may be active, or the mapper would prefer the points.
  layer.surface->GetPointData()->SetScalars(nullptr);
  layer.surface->GetCellData()->SetScalars(nullptr);
  fields->SetScalars(scalars);
  return true;
}

using Test = bool (*)(const Layer&, const PictureOptions&);

bool has_warp(const Layer& layer, const PictureOptions& options) {
  return !full_name(*layer.data->GetPointData(), options.warp).empty();
}

bool has_lines(const Layer& layer, const PictureOptions& options) {
  const auto* array = layer.data->GetCellData()->GetArray(full_name(*layer.data->GetCellData(), options.lines).c_str());
  return array && array->GetNumberOfComponents() == 3;
}

bool has_stream(const Layer& layer, const PictureOptions& options) {
  const std::string name = full_name(*layer.data->GetPointData(), options.streamlines);
  const auto* array = name.empty() ? nullptr : layer.data->GetPointData()->GetArray(name.c_str());
  return array && array->GetNumberOfComponents() == 3;
}

/// A vector array that is asked for has to be in a file at least.
void demand(const std::vector<Layer>& layers, const PictureOptions& options, const std::string& name,
            const std::string& what, Test has) {
  if (name.empty() || std::any_of(layers.begin(), layers.end(), [&](const Layer& l) { return has(l, options); }))
    return;
  throw InputError("picture", fmt::format("no input has a {}", fmt::format(fmt::runtime(what), name)),
                   "arrays that exist: " + array_names(layers));
}

/// Lines along the vectors of all files that have them, as one layer; the skins become a shell around it.
void add_streamlines(std::vector<Layer>& layers, const PictureOptions& options) {
  std::vector<vtkPointSet*> volumes;
  std::string vector;
  for (const auto& layer : layers)
    if (has_stream(layer, options)) {
      volumes.push_back(layer.data.get());
      vector = full_name(*layer.data->GetPointData(), options.streamlines);
    }
  const auto lines =
      vtkSmartPointer<vtkPolyData>::Take(trace_streamlines(volumes, {.vector = vector, .seeds = options.seeds}));
  Layer layer{.file = "streamlines", .data = kept<vtkPointSet>(lines), .surface = kept(lines.Get())};
  PictureOptions colours = options;
  if (colours.array.empty()) colours.array = options.streamlines;
  layer.coloured = set_scalars(layer, colours);
  layer.lines = true;
  for (auto& other : layers) other.coloured = false;
  layers.push_back(std::move(layer));
}

}  // namespace

std::vector<Layer> make_layers(const std::vector<std::string>& files, const PictureOptions& options) {
  std::vector<Layer> layers;
  for (const auto& file : files) layers.push_back(read_layer(file));
  demand(layers, options, options.warp, "point array '{}' to warp by", has_warp);
  demand(layers, options, options.lines, "cell array '{}' of vectors to draw lines along", has_lines);
  demand(layers, options, options.streamlines, "point array '{}' of vectors to follow", has_stream);
  bool any_coloured = false;
  for (auto& layer : layers) {
    make_surface(layer, options);
    layer.coloured = !options.array.empty() && set_scalars(layer, options);
    any_coloured |= layer.coloured;
  }
  if (!options.array.empty() && !any_coloured)
    throw InputError("picture", fmt::format("no input has an array '{}' to colour by", options.array),
                     "arrays that exist: " + array_names(layers));
  if (!options.streamlines.empty()) add_streamlines(layers, options);
  std::erase_if(layers, [](const Layer& layer) { return layer.surface->GetNumberOfCells() == 0; });
  const bool plain = options.array.empty() && options.streamlines.empty();
  const auto in_sight = [&](const Layer& layer) { return layer.coloured || plain; };
  if (std::none_of(layers.begin(), layers.end(), in_sight))
    throw InputError("picture clip", "the plane cuts everything away", "move or turn the plane");
  return layers;
}

std::vector<double> values_in_sight(const std::vector<Layer>& layers) {
  std::vector<double> values;
  for (const auto& layer : layers) {
    if (!layer.coloured) continue;
    auto* scalars = layer.surface->GetPointData()->GetScalars();
    if (!scalars) scalars = layer.surface->GetCellData()->GetScalars();
    for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
      if (const double value = scalars->GetComponent(i, 0); std::isfinite(value)) values.push_back(value);
  }
  return values;
}

std::string lines_array(const Layer& layer, const PictureOptions& options) {
  return full_name(*layer.surface->GetCellData(), options.lines);
}

}  // namespace tunica::drawing
