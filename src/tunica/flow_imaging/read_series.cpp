#include "tunica/flow_imaging/read_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/imaging/value_image.hpp"

namespace tunica::flow_imaging {

namespace {

namespace fs = std::filesystem;
using config::Problems;
using config::Schema;
namespace dimension = config::dimension;
using imaging::ValueImage;

void require_same_voxels(const ImageFrame& a, const ImageFrame& b, const std::string& first,
                         const std::string& second) {
  bool same = a.size == b.size;
  const double tolerance = 1e-3 * norm(a.steps[0]);
  for (std::size_t d = 0; d < 3 && same; ++d)
    same = norm(a.steps[d] - b.steps[d]) * static_cast<double>(a.size[d]) < tolerance * 10;
  if (!same || norm(a.origin - b.origin) > 10 * tolerance)
    throw InputError(second, fmt::format("has other voxels than {}", first),
                     "give images of one grid: the same size, spacing, origin and directions");
}

/// Goes through the frames of one or several files: `take(frame, values)` gets per_voxel values for each voxel, or of a
/// file that has components after the times those of one component, its number first.
class FrameReader {
 public:
  FrameReader(const fs::path& path, std::string where)
      : where_(std::move(where)), files_(files_of_frames(path, where_)) {}

  const std::vector<std::string>& files() const { return files_; }
  template <class Take>
  void run(VelocitySeries& series, std::string& first, std::vector<std::string>& names, std::int64_t values,
           const Take& take) {
    std::vector<std::string> here;
    for (const auto& file : files_) {
      ValueImage image = imaging::open_value_image(file);
      if (first.empty()) {
        series.frame = image.frame;
        first = file;
        if (image.times > 1 && image.time_step > 0) step_ = image.time_step;
      } else {
        require_same_voxels(series.frame, image.frame, first, file);
      }
      if (image.per_voxel * image.components != values)
        throw InputError(file,
                         fmt::format("has {} values for each voxel and frame, here {} are due",
                                     image.per_voxel * image.components, values),
                         values == 3 ? "give `x`, `y` and `z` for files of one component"
                                     : "give `field` for a file of all three components");
      if (files_.size() > 1 && image.times > 1)
        throw InputError(file, fmt::format("has {} frames, and its name stands for one", image.times),
                         "give one file of all frames, or one file for each");
      for (std::int64_t component = 0; component < image.components; ++component)
        for (std::int64_t t = 0; t < image.times; ++t) {
          const auto frame = here.size() - (component > 0 ? static_cast<std::size_t>(image.times - t) : 0);
          if (component == 0)
            here.push_back(image.times > 1 ? fmt::format("{} of {}", t, fs::path(file).filename().string())
                                           : fs::path(file).filename().string());
          take(frame, component, image.next_volume());
        }
    }
    if (!names.empty() && names.size() != here.size())
      throw InputError(where_, fmt::format("has {} frames, the first component has {}", here.size(), names.size()),
                       "give all components at the same times");
    if (names.empty()) names = here;
  }
  double step() const { return step_; }

 private:
  std::string where_;
  std::vector<std::string> files_;
  double step_ = 0;
};

/// Components of all voxels from those along the encoded axes, which are unit vectors; in place.
void turn(VelocitySeries& series, const SeriesFiles& files) {
  if (files.axes == SeriesFiles::Axes::patient) return;
  for (auto& v : series.velocity)
    for (std::size_t n = 0; n < v[0].size(); ++n) {
      Vec3<double> u{};
      for (std::size_t a = 0; a < 3; ++a) u = u + static_cast<double>(v[a][n]) * series.encoded[a];
      for (std::size_t d = 0; d < 3; ++d) v[d][n] = static_cast<float>(u[static_cast<int>(d)]);
    }
}

void check_files(const SeriesFiles& f, Problems& problems) {
  const int components = f.x.has_value() + f.y.has_value() + f.z.has_value();
  if (f.field ? components != 0 : components != 3)
    problems.add("", "names no three components", "give `x`, `y` and `z`, or `field` for files with all of them");
  for (const double s : f.signs)
    if (std::abs(s) != 1) problems.add("signs", fmt::format("has {}", s), "write 1 or -1 for each component");
}

}  // namespace

Schema<SeriesFiles> SeriesFiles::schema() {
  using F = SeriesFiles;
  return Schema<F>("velocity", "Velocity images over a heart beat (4D flow).")
      .path("x", &F::x, "First component: a file of all frames, or a name with * for one file a frame")
      .path("y", &F::y, "Second component")
      .path("z", &F::z, "Third component")
      .path("field", &F::field, "All three components of each voxel, in place of x, y and z")
      .path("magnitude", &F::magnitude,
            "Magnitude images: tell tissue from air, and how noise and partial volume count")
      .unit("unit", &F::unit, dimension::velocity, "Of the numbers in the files; of phase images the velocity of 1")
      .quantity("encoding", &F::encoding, dimension::velocity, config::above(0),
                "Encoding velocity: what is faster has wrapped; left out where nothing has")
      .plausible("20 cm/s", "6 m/s")
      .quantity("period", &F::period, dimension::time, config::above(0), "Of the heart beat")
      .plausible("0.3 s", "2 s")
      .quantities("times", &F::times, dimension::time, config::at_least(0),
                  "Of the frames since the trigger; equal parts of the period when left out")
      .by_default("[]")
      .choice("axes", &F::axes, {{"patient", Axes::patient}, {"image", Axes::image}},
              "Along which the components are: left, back and head of the patient, or columns, rows and slices")
      .by_default()
      .quantities("signs", &F::signs, dimension::none, config::range(-1, 1),
                  "Of the components, where a scanner turns them")
      .by_default("[1, 1, 1]")
      .check(check_files);
}

std::vector<std::string> files_of_frames(const fs::path& path, const std::string& where, const std::string& item) {
  const std::string pattern = path.filename().string();
  const auto star = pattern.find('*');
  if (star == std::string::npos) return {path.string()};
  if (pattern.find('*', star + 1) != std::string::npos)
    throw InputError(where, fmt::format("{} has more than one *", pattern), "write one * in place of the number");
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  std::error_code error;
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (files::fits(pattern, entry.path().filename().string())) found.push_back(entry.path().string());
  if (found.empty())
    throw InputError(where, fmt::format("no file is named like {}", path.string()), "check folder and name");
  return in_order_of_numbers(std::move(found), where, item);
}

VelocitySeries read_series(const SeriesFiles& files, const std::string& where) {
  VelocitySeries series;
  std::string first;
  std::vector<std::string> names;
  double step = 0;
  const auto store = [&](std::size_t frame, std::size_t component, std::vector<float> values) {
    if (series.velocity.size() <= frame) series.velocity.resize(frame + 1);
    const auto factor = static_cast<float>(files.unit * files.signs[component]);
    for (auto& v : values) v *= factor;
    series.velocity[frame][component] = std::move(values);
  };
  if (files.field) {
    FrameReader reader(*files.field, where + ".field");
    reader.run(series, first, names, 3, [&](std::size_t frame, std::int64_t component, std::vector<float> values) {
      if (std::ssize(values) == series.voxels())
        return store(frame, static_cast<std::size_t>(component), std::move(values));
      for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> one(static_cast<std::size_t>(series.voxels()));
        for (std::size_t n = 0; n < one.size(); ++n) one[n] = values[3 * n + c];
        store(frame, c, std::move(one));
      }
    });
    step = reader.step();
  } else {
    const std::optional<fs::path>* paths[3] = {&files.x, &files.y, &files.z};
    const char* keys[3] = {".x", ".y", ".z"};
    for (std::size_t c = 0; c < 3; ++c) {
      FrameReader reader(paths[c]->value(), where + keys[c]);
      reader.run(series, first, names, 1, [&](std::size_t frame, std::int64_t, std::vector<float> values) {
        store(frame, c, std::move(values));
      });
      if (c == 0) step = reader.step();
    }
  }
  if (files.magnitude) {
    FrameReader reader(*files.magnitude, where + ".magnitude");
    series.magnitude.assign(static_cast<std::size_t>(series.voxels()), 0.0F);
    std::vector<std::string> of_magnitude;
    std::size_t count = 0;
    reader.run(series, first, of_magnitude, 1, [&](std::size_t, std::int64_t, const std::vector<float>& values) {
      ++count;
      for (std::size_t n = 0; n < values.size(); ++n) series.magnitude[n] += values[n];
    });
    for (auto& m : series.magnitude) m /= static_cast<float>(count);
  }
  series.period = files.period;
  auto times = files.times;
  if (times.empty() && step > 0) {
    for (std::size_t k = 0; k < names.size(); ++k) times.push_back(step * static_cast<double>(k));
  }
  series.times = frame_times(times, files.period, names, where + ".times");
  series.encoding = files.encoding;
  for (std::size_t a = 0; a < 3; ++a) {
    series.encoded[a] = files.axes == SeriesFiles::Axes::image
                            ? (1 / norm(series.frame.steps[a])) * series.frame.steps[a]
                            : Vec3<double>{};
    if (files.axes == SeriesFiles::Axes::patient) series.encoded[a][static_cast<int>(a)] = 1;
  }
  turn(series, files);
  check_plausible(series, where + ".unit");
  return series;
}

void write_series(const VelocitySeries& series, const fs::path& folder) {
  const double step = series.period / static_cast<double>(series.frames());
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<std::vector<float>> along(series.frames(),
                                          std::vector<float>(static_cast<std::size_t>(series.voxels())));
    for (std::size_t k = 0; k < series.frames(); ++k)
      for (std::size_t n = 0; n < along[k].size(); ++n) {
        double v = 0;
        for (std::size_t d = 0; d < 3; ++d)
          v += series.encoded[c][static_cast<int>(d)] * static_cast<double>(series.velocity[k][d][n]);
        along[k][n] = static_cast<float>(v);
      }
    imaging::write_value_series(series.frame, along, step, folder / fmt::format("velocity_{}.nii.gz", "xyz"[c]));
  }
  if (!series.magnitude.empty())
    imaging::write_value_series(series.frame, {series.magnitude}, step, folder / "magnitude.nii.gz");
}

}  // namespace tunica::flow_imaging
