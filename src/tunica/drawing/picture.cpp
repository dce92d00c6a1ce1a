#include "tunica/drawing/picture.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWarpVector.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/drawing/picture_data.hpp"
#include "tunica/drawing/picture_file.hpp"
#include "tunica/drawing/picture_lines.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::drawing {
namespace {

constexpr double bar_begin = 0.86;    // the colour bar takes the right of the picture from here on
constexpr double title_begin = 0.92;  // and the title the top

/// One data set on its way into the picture.
struct Layer {
  std::string file;
  vtkSmartPointer<vtkPointSet> data;
  vtkSmartPointer<vtkPolyData> surface;
  bool coloured = false;
  std::string array = {};  ///< full name of what it is coloured by
};

void check(const PictureOptions& options) {
  std::vector<Problem> problems;
  if (options.inputs.empty()) problems.push_back({"picture", "no input files", "name at least one file to draw"});
  if (!options.output.ends_with(".png"))
    problems.push_back({options.output, "pictures are written as PNG", "let the name end in .png"});
  const auto folder = std::filesystem::absolute(options.output).parent_path();
  if (!std::filesystem::is_directory(folder))
    problems.push_back({options.output, "the folder does not exist", "make it first: mkdir -p " + folder.string()});
  if (std::min(options.width, options.height) < 64 || std::max(options.width, options.height) > 16384)
    problems.push_back({"picture size", fmt::format("{} x {}, allowed 64 to 16384", options.width, options.height),
                        "choose a size in that range"});
  if (!(norm(cross(options.view, options.up)) > 1e-6 * norm(options.view) * norm(options.up)))
    problems.push_back({"picture view", "view direction and up direction are parallel or zero",
                        "let them differ, for example --up 0 1 0"});
  if (options.focus && !(options.focus->radius > 0.0))
    problems.push_back({"picture focus", fmt::format("a radius of {}", options.focus->radius), "give one above 0"});
  if (!(options.line_length >= 0.0))
    problems.push_back({"picture lines", fmt::format("a length of {}", options.line_length), "give one above 0"});
  if (options.clip && !(norm(options.clip->normal) > 0.0))
    problems.push_back({"picture clip", "the normal is zero", "give the direction in which to cut away"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// A connection to the X display. VTK aborts the program if there is none, so this is found out beforehand; and it is
/// kept while VTK draws, because a virtual display resets itself when its last client leaves.
class Display {
 public:
  Display() {
    const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(RTLD_DEFAULT, "XOpenDisplay"));
    if (open && std::getenv("DISPLAY")) connection_ = open(nullptr);
    if (!connection_)
      throw SolverError("no X display to draw on: put 'xvfb-run -a' in front of the command, which provides one");
  }
  ~Display() {
    const auto close = reinterpret_cast<int (*)(void*)>(dlsym(RTLD_DEFAULT, "XCloseDisplay"));
    if (close) close(connection_);
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

 private:
  void* connection_ = nullptr;
};

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

Layer read_layer(const std::string& file) {
  const auto data = vtkSmartPointer<vtkPointSet>::Take(read_points(file));
  if (data->GetNumberOfPoints() == 0) throw InputError(file, "holds no points", "give a file with a mesh");
  return {.file = file, .data = data, .surface = nullptr};
}

/// Moves, cuts and skins the data of a layer.
void make_surface(Layer& layer, const PictureOptions& options) {
  vtkSmartPointer<vtkDataSet> data = layer.data;
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
  layer.surface = normals->GetOutput();
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

std::vector<Layer> make_layers(const std::vector<std::string>& files, const PictureOptions& options) {
  std::vector<Layer> layers;
  for (const auto& file : files) layers.push_back(read_layer(file));
  const auto warped = [&](const Layer& layer) { return !full_name(*layer.data->GetPointData(), options.warp).empty(); };
  if (!options.warp.empty() && std::none_of(layers.begin(), layers.end(), warped))
    throw InputError("picture", fmt::format("no input has a point array '{}' to warp by", options.warp),
                     "arrays that exist: " + array_names(layers));
  bool any_coloured = false;
  for (auto& layer : layers) {
    make_surface(layer, options);
    layer.coloured = !options.array.empty() && set_scalars(layer, options);
    any_coloured |= layer.coloured;
  }
  if (!options.array.empty() && !any_coloured)
    throw InputError("picture", fmt::format("no input has an array '{}' to colour by", options.array),
                     "arrays that exist: " + array_names(layers));
  const auto has_lines = [&](const Layer& layer) {
    const auto* array =
        layer.data->GetCellData()->GetArray(full_name(*layer.data->GetCellData(), options.lines).c_str());
    return array && array->GetNumberOfComponents() == 3;
  };
  if (!options.lines.empty() && std::none_of(layers.begin(), layers.end(), has_lines))
    throw InputError("picture",
                     fmt::format("no input has a cell array '{}' of vectors to draw lines along", options.lines),
                     "arrays that exist: " + array_names(layers));
  std::erase_if(layers, [](const Layer& layer) { return layer.surface->GetNumberOfCells() == 0; });
  const auto in_sight = [&](const Layer& layer) { return layer.coloured || options.array.empty(); };
  if (std::none_of(layers.begin(), layers.end(), in_sight))
    throw InputError("picture clip", "the plane cuts everything away", "move or turn the plane");
  return layers;
}

std::array<double, 2> colour_limits(const std::vector<Layer>& layers, const PictureOptions& options) {
  if (options.limits) return *options.limits;
  std::vector<double> values;
  for (const auto& layer : layers) {
    if (!layer.coloured) continue;
    auto* scalars = layer.surface->GetPointData()->GetScalars();
    if (!scalars) scalars = layer.surface->GetCellData()->GetScalars();
    for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
      if (const double value = scalars->GetComponent(i, 0); std::isfinite(value)) values.push_back(value);
  }
  if (values.empty()) return {0.0, 1.0};
  const auto below = static_cast<std::ptrdiff_t>(options.percentile / 100 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + below, values.end());
  std::array<double, 2> limits = {*std::min_element(values.begin(), values.begin() + below + 1), values[below]};
  // Round-off about zero would only clutter the labels.
  for (double& limit : limits)
    if (std::abs(limit) < 1e-9 * (limits[1] - limits[0])) limit = 0.0;
  return limits;
}

/// A perceptually even map from dark blue over green to yellow (anchor colours of "viridis", released as CC0).
vtkSmartPointer<vtkLookupTable> colour_table(const std::array<double, 2>& limits) {
  static constexpr int anchors[][3] = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142}, {38, 130, 142},
                                       {31, 158, 137}, {53, 183, 121}, {109, 205, 89}, {180, 222, 44}, {253, 231, 37}};
  constexpr int intervals = static_cast<int>(std::size(anchors)) - 1, colours = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(colours);
  table->SetTableRange(limits[0], limits[1]);
  for (int i = 0; i < colours; ++i) {
    const double at = static_cast<double>(i) * intervals / (colours - 1);
    const int low = std::min(static_cast<int>(at), intervals - 1);
    double rgb[3];
    for (int c = 0; c < 3; ++c)
      rgb[c] = (anchors[low][c] + (at - low) * (anchors[low + 1][c] - anchors[low][c])) / 255.0;
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  return table;
}

void add_actors(vtkRenderer& scene, const std::vector<Layer>& layers, const PictureOptions& options,
                vtkLookupTable* table) {
  for (const auto& layer : layers) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(layer.surface);
    mapper->SetScalarVisibility(layer.coloured);
    if (layer.coloured) {
      mapper->SetLookupTable(table);
      mapper->UseLookupTableScalarRangeOn();
      mapper->InterpolateScalarsBeforeMappingOn();
    }
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    auto* look = actor->GetProperty();
    look->SetColor(0.72, 0.74, 0.78);
    look->SetOpacity(layer.coloured || options.array.empty() ? 1.0 : 0.25);
    look->SetAmbient(0.25);
    look->SetDiffuse(0.75);
    look->SetEdgeVisibility(options.edges);
    look->SetEdgeColor(0.2, 0.2, 0.2);
    look->SetLineWidth(0.5F);
    scene.AddActor(actor);
  }
}

/// A box along the axes of the picture: right, up, towards the camera.
struct Sight {
  Vec3<double> axes[3], low, high;
  Vec3<double> size() const { return high - low; }
  Vec3<double> centre() const {
    Vec3<double> c = {{0.0, 0.0, 0.0}};
    for (int a = 0; a < 3; ++a) c = c + (0.5 * (low[a] + high[a])) * axes[a];
    return c;
  }
};

/// Everything that is drawn, or what the options focus on.
Sight find_sight(const std::vector<Layer>& layers, const PictureOptions& options) {
  Sight sight;
  sight.axes[2] = (1.0 / norm(options.view)) * options.view;
  const auto right = cross(options.up, sight.axes[2]);
  sight.axes[0] = (1.0 / norm(right)) * right;
  sight.axes[1] = cross(sight.axes[2], sight.axes[0]);
  for (int a = 0; a < 3; ++a) {
    sight.low[a] = std::numeric_limits<double>::max();
    sight.high[a] = std::numeric_limits<double>::lowest();
  }
  for (const auto& layer : layers)
    for (vtkIdType i = 0; i < layer.surface->GetNumberOfPoints(); ++i) {
      Vec3<double> point;
      layer.surface->GetPoint(i, point.x);
      for (int a = 0; a < 3; ++a) {
        sight.low[a] = min(sight.low[a], dot(sight.axes[a], point));
        sight.high[a] = max(sight.high[a], dot(sight.axes[a], point));
      }
    }
  for (int a = 0; a < 3 && options.focus; ++a) {
    sight.low[a] = dot(sight.axes[a], options.focus->centre) - options.focus->radius;
    sight.high[a] = sight.low[a] + 2.0 * options.focus->radius;
  }
  return sight;
}

/// Looks along -view in parallel projection, with what is in sight as large as it goes.
void set_camera(vtkRenderer& scene, const Sight& sight, const PictureOptions& options) {
  const auto size = sight.size(), centre = sight.centre(), eye = centre + (2.0 * norm(size)) * sight.axes[2];
  auto* camera = scene.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(centre.x);
  camera->SetPosition(eye[0], eye[1], eye[2]);
  camera->SetViewUp(sight.axes[1].x);
  const double aspect = bar_begin * options.width / (title_begin * options.height);
  camera->SetParallelScale(0.5 * 1.08 * max(size[1], size[0] / aspect));
  scene.ResetCameraClippingRange();
}

void add_all_lines(vtkRenderer& scene, const std::vector<Layer>& layers, const Sight& sight,
                   const PictureOptions& options) {
  const double length = options.line_length > 0 ? options.line_length : norm(sight.size()) / 100;
  for (const auto& layer : layers)
    if (const auto array = full_name(*layer.surface->GetCellData(), options.lines); !array.empty())
      add_lines(scene, *layer.surface, {array, length, sight.axes[2]});
}

/// Letters grow with the picture; one that stands upright is narrow where they are.
int letters(const PictureOptions& options, int share) {
  return std::min(options.height, 2 * options.width / 3) / share;
}

void style_text(vtkTextProperty* text, int size) {
  text->SetFontFamilyToArial();
  text->SetColor(0.1, 0.1, 0.1);
  text->SetFontSize(size);
  text->BoldOff();
  text->ItalicOff();
  text->ShadowOff();
}

void add_colour_bar(vtkRenderer& frame, const std::vector<Layer>& layers, const PictureOptions& options,
                    vtkLookupTable* table) {
  const auto coloured = std::find_if(layers.begin(), layers.end(), [](const Layer& layer) { return layer.coloured; });
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  std::string name = options.label.empty() && coloured != layers.end() ? coloured->array : options.label;
  if (const auto unit = name.find_last_of("[("); unit != std::string::npos && unit > 0 && name[unit - 1] == ' ')
    name[unit - 1] = '\n';
  bar->SetTitle(name.c_str());
  bar->SetNumberOfLabels(6);
  bar->SetLabelFormat("%.4g");
  bar->UnconstrainedFontSizeOn();
  bar->SetPosition(bar_begin + 0.01, 0.1);
  bar->SetPosition2(1.0 - bar_begin - 0.02, 0.78);
  bar->SetBarRatio(0.25);
  bar->SetMaximumNumberOfColors(256);
  bar->SetTextPad(4);
  bar->SetVerticalTitleSeparation(letters(options, 60));
  style_text(bar->GetTitleTextProperty(), std::max(10, letters(options, 45)));
  style_text(bar->GetLabelTextProperty(), std::max(9, letters(options, 50)));
  frame.AddActor2D(bar);
}

void add_title(vtkRenderer& frame, const PictureOptions& options, std::optional<double> time) {
  std::string text = options.title;
  if (time) text += fmt::format("{}t = {:.6g} s", text.empty() ? "" : ",  ", *time);
  if (text.empty()) return;
  vtkNew<vtkTextActor> title;
  title->SetInput(text.c_str());
  title->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  title->SetPosition(0.02, title_begin + 0.02);
  style_text(title->GetTextProperty(), std::max(12, letters(options, 32)));
  frame.AddActor2D(title);
}

void write_picture(vtkRenderWindow& window, const std::string& file) {
  window.Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (writer->GetErrorCode() != 0 || !png || png->GetNumberOfValues() == 0)
    throw SolverError(fmt::format("cannot write {}: VTK error code {}", file, writer->GetErrorCode()));
  files::write_atomically(
      file, {reinterpret_cast<const char*>(png->GetPointer(0)), static_cast<std::size_t>(png->GetNumberOfValues())});
}

}  // namespace

PictureSummary render(const PictureOptions& options) {
  check(options);
  files::try_output(options.output);
  PictureSummary summary;
  std::vector<std::string> files;
  for (const auto& input : options.inputs) {
    const auto steps = read_series(input);
    const auto& step = pick_step(steps, options.time);
    files.insert(files.end(), step.files.begin(), step.files.end());
    if (!summary.time) summary.time = step.time;
  }
  const auto layers = make_layers(files, options);
  const Display display;

  // The frame with its text fills the window; the scene lies above it and leaves room for title and colour bar.
  vtkNew<vtkRenderer> frame, scene;
  frame->SetBackground(1.0, 1.0, 1.0);
  scene->SetLayer(1);
  scene->SetViewport(0.0, 0.0, options.array.empty() ? 1.0 : bar_begin, title_begin);
  vtkSmartPointer<vtkLookupTable> table;
  if (!options.array.empty()) {
    summary.limits = colour_limits(layers, options);
    table = colour_table(summary.limits);
    add_colour_bar(*frame, layers, options, table);
  }
  add_title(*frame, options, summary.time);
  add_actors(*scene, layers, options, table);
  const auto sight = find_sight(layers, options);
  if (!options.lines.empty()) add_all_lines(*scene, layers, sight, options);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetNumberOfLayers(2);
  window->SetSize(options.width, options.height);
  window->AddRenderer(frame);
  window->AddRenderer(scene);
  set_camera(*scene, sight, options);
  write_picture(*window, options.output);
  return summary;
}

}  // namespace tunica::drawing
