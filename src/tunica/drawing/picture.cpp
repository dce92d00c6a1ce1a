#include "tunica/drawing/picture.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/drawing/movie.hpp"
#include "tunica/drawing/picture_colours.hpp"
#include "tunica/drawing/picture_data.hpp"
#include "tunica/drawing/picture_layers.hpp"
#include "tunica/drawing/picture_lines.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::drawing {
namespace {

void check(const PictureOptions& options) {
  std::vector<Problem> problems;
  if (options.inputs.empty()) problems.push_back({"picture", "no input files", "name at least one file to draw"});
  const auto ends = [&](const char* ending) { return options.output.ends_with(ending); };
  if (!options.movie && !ends(".png"))
    problems.push_back({options.output, "pictures are written as PNG", "let the name end in .png"});
  if (options.movie && !ends(".png") && !ends(".webm") && !ends(".gif"))
    problems.push_back(
        {options.output, "is no name of a movie", "let it end in .webm, .gif, or .png for single pictures"});
  if (!(options.frame_rate > 0 && options.frame_rate <= 100))
    problems.push_back(
        {"picture frame rate", fmt::format("{} steps in a second", options.frame_rate), "give 1 to 100"});
  if (options.seeds < 1 || options.seeds > 100000)
    problems.push_back({"picture seeds", fmt::format("{} points", options.seeds), "give 1 to 100000"});
  const auto folder = std::filesystem::absolute(options.output).parent_path();
  if (!std::filesystem::is_directory(folder))
    problems.push_back({options.output, "the folder does not exist", "make it first: mkdir -p " + folder.string()});
  const bool fits = options.width == 0 && options.height == 0;
  if (!fits && (std::min(options.width, options.height) < 64 || std::max(options.width, options.height) > 16384))
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

/// Streamlines as tubes; everything else as it is.
void set_data(vtkPolyDataMapper& mapper, const Layer& layer, double size) {
  if (!layer.lines) return mapper.SetInputData(layer.surface.get());
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(layer.surface.get());
  tubes->SetRadius(0.002 * size);
  tubes->SetNumberOfSides(8);
  mapper.SetInputConnection(tubes->GetOutputPort());
}

/// `size`: of what is in sight, in the unit of the files.
void add_actors(vtkRenderer& scene, const std::vector<Layer>& layers, double size, const ColourScale& scale,
                vtkLookupTable& table, const PictureOptions& options) {
  const bool plain = std::none_of(layers.begin(), layers.end(), [](const Layer& l) { return l.coloured; });
  for (const auto& layer : layers) {
    vtkNew<vtkPolyDataMapper> mapper;
    set_data(*mapper, layer, size);
    mapper->SetScalarVisibility(layer.coloured);
    if (layer.coloured) {
      mapper->SetLookupTable(&table);
      mapper->UseLookupTableScalarRangeOn();
      if (scale.kind != ColourKind::categories) mapper->InterpolateScalarsBeforeMappingOn();
    }
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    auto* look = actor->GetProperty();
    look->SetColor(0.72, 0.74, 0.78);
    look->SetOpacity(layer.coloured || plain ? 1.0 : layers.back().lines ? 0.15 : 0.25);
    look->SetAmbient(0.25);
    look->SetDiffuse(0.75);
    look->SetEdgeVisibility(options.edges && !layer.lines);
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
    if (const auto array = lines_array(layer, options); !array.empty())
      add_lines(scene, *layer.surface, {array, length, sight.axes[2]});
}

/// Two boxes of the same axes as one.
Sight both(Sight a, const Sight& b) {
  for (int k = 0; k < 3; ++k) {
    a.low[k] = min(a.low[k], b.low[k]);
    a.high[k] = max(a.high[k], b.high[k]);
  }
  return a;
}

/// A size in which what is in sight fills the picture; movies have even ones, as their encoders ask for.
void choose_size(PictureOptions& options, const Sight& sight) {
  if (options.width == 0) {
    const auto size = sight.size();
    const double aspect = max(size[0], 1e-9 * size[1]) / max(size[1], 1e-9 * size[0]);
    const double scene = std::clamp(aspect, 0.45, 2.2) * title_begin / bar_begin;
    options.height = static_cast<int>(std::min(1000.0, 1400.0 / scene));
    options.width = static_cast<int>(scene * options.height);
  }
  if (options.movie) options.width += options.width % 2, options.height += options.height % 2;
}

/// Everything about a picture but its data: the same for all steps of a movie.
struct Look {
  PictureOptions options;
  ColourScale scale;
  Sight sight;
};

std::string title_of(const PictureOptions& options, std::optional<double> time) {
  if (!time) return options.title;
  return fmt::format("{}{}t = {:.6g} s", options.title, options.title.empty() ? "" : ",  ", *time);
}

/// The frame with its text fills the window; the scene lies above it and leaves room for title and key. Calls `use`
/// with the window once it is drawn.
template <class Use>
void draw(const std::vector<Layer>& layers, const Look& look, std::optional<double> time, const Use& use) {
  const auto& options = look.options;
  const auto coloured = std::find_if(layers.begin(), layers.end(), [](const Layer& layer) { return layer.coloured; });
  vtkNew<vtkRenderer> frame, scene;
  frame->SetBackground(1.0, 1.0, 1.0);
  scene->SetLayer(1);
  scene->SetViewport(0.0, 0.0, coloured == layers.end() ? 1.0 : bar_begin, title_begin);
  vtkNew<vtkLookupTable> table;
  fill_table(*table, look.scale);
  if (coloured != layers.end()) add_colour_key(*frame, look.scale, *table, coloured->array, options);
  add_title(*frame, title_of(options, time), options);
  add_actors(*scene, layers, norm(look.sight.size()), look.scale, *table, options);
  if (!options.lines.empty()) add_all_lines(*scene, layers, look.sight, options);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetNumberOfLayers(2);
  window->SetSize(options.width, options.height);
  window->AddRenderer(frame);
  window->AddRenderer(scene);
  set_camera(*scene, look.sight, options);
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  use(*image);
}

void write_png(vtkWindowToImageFilter& image, const std::string& file) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetCompressionLevel(9);
  writer->WriteToMemoryOn();
  writer->SetInputConnection(image.GetOutputPort());
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (writer->GetErrorCode() != 0 || !png || png->GetNumberOfValues() == 0)
    throw SolverError(fmt::format("cannot write {}: VTK error code {}", file, writer->GetErrorCode()));
  files::write_atomically(
      file, {reinterpret_cast<const char*>(png->GetPointer(0)), static_cast<std::size_t>(png->GetNumberOfValues())});
}

/// Rows from the top, three bytes a pixel.
std::vector<std::uint8_t> pixels_of(vtkWindowToImageFilter& image, const PictureOptions& options) {
  image.Update();
  vtkImageData* data = image.GetOutput();
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3UL * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
  for (int y = options.height - 1; y >= 0; --y) {
    const auto* row = static_cast<const std::uint8_t*>(data->GetScalarPointer(0, y, 0));
    pixels.insert(pixels.end(), row, row + 3 * options.width);
  }
  return pixels;
}

/// Files of one picture.
struct Step {
  std::optional<double> time;
  std::vector<std::string> files;
};

Step step_at(const std::vector<std::vector<SeriesStep>>& series, std::optional<double> time) {
  Step result;
  for (const auto& steps : series) {
    const auto& step = pick_step(steps, time);
    result.files.insert(result.files.end(), step.files.begin(), step.files.end());
    if (!result.time) result.time = step.time;
  }
  return result;
}

/// One step, or all of the first series that has times.
std::vector<Step> steps_of(const PictureOptions& options) {
  std::vector<std::vector<SeriesStep>> series;
  for (const auto& input : options.inputs) series.push_back(read_series(input));
  if (!options.movie) return {step_at(series, options.time)};
  const auto timed =
      std::find_if(series.begin(), series.end(), [](const auto& steps) { return steps.size() > 1 && steps[0].time; });
  if (timed == series.end())
    throw InputError("picture movie", "no input is a series of several steps", "give the .hdf.series of a run");
  std::vector<Step> steps;
  for (const auto& step : *timed) steps.push_back(step_at(series, step.time));
  return steps;
}

/// Colours and place that suit all steps. Layers of a single one are kept in `layers`.
Look look_of(const std::vector<Step>& steps, const PictureOptions& options, std::vector<Layer>& layers) {
  Look look{options, {}, {}};
  std::vector<double> values;
  bool whole = true;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    layers = make_layers(steps[k].files, options);
    const auto more = values_in_sight(layers);
    values.insert(values.end(), more.begin(), more.end());
    for (const auto& layer : layers) whole = whole && (!layer.coloured || layer.whole_numbers);
    look.sight = k == 0 ? find_sight(layers, options) : both(look.sight, find_sight(layers, options));
  }
  look.scale = colour_scale(std::move(values), whole, options);
  choose_size(look.options, look.sight);
  return look;
}

/// beat.png -> beat_0007.png
std::string numbered(const std::string& file, std::size_t number) {
  return fmt::format("{}_{:04}.png", file.substr(0, file.size() - 4), number);
}

void write_movie(const std::vector<Step>& steps, const Look& look) {
  std::optional<Movie> movie;
  const auto& o = look.options;
  const bool single = o.output.ends_with(".png");
  if (!single) movie.emplace(o.output, o.width, o.height, o.frame_rate);
  for (std::size_t k = 0; k < steps.size(); ++k)
    draw(make_layers(steps[k].files, o), look, steps[k].time, [&](vtkWindowToImageFilter& image) {
      if (single)
        write_png(image, numbered(o.output, k + 1));
      else
        movie->add(pixels_of(image, o));
    });
  if (movie) movie->finish();
}

}  // namespace

PictureSummary render(const PictureOptions& options) {
  check(options);
  files::try_output(options.output);
  if (options.movie && !options.output.ends_with(".png")) Movie::demand_encoder();
  const auto steps = steps_of(options);
  std::vector<Layer> layers;
  const auto look = look_of(steps, options, layers);
  const Display display;
  if (options.movie)
    write_movie(steps, look);
  else
    draw(layers, look, steps[0].time, [&](vtkWindowToImageFilter& image) { write_png(image, options.output); });
  return {steps[0].time, look.scale.limits, steps.size()};
}

}  // namespace tunica::drawing
