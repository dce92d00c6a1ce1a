// Which files a `mesh-complete` folder holds.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tunica/base/error.hpp"
#include "tunica/mesh_io/simvascular.hpp"

namespace tunica::mesh_io {

namespace fs = std::filesystem;

namespace {

constexpr const char *volume_name = "mesh-complete.mesh.vtu", *surface_folder = "mesh-surfaces";

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

struct SurfaceFiles {
  std::vector<fs::path> files;    ///< sorted
  std::vector<fs::path> ignored;  ///< hidden ones, such as the `._*.vtp` that macOS puts beside files on other disks
};

/// Sorted; none, with an error, where there is no such folder.
SurfaceFiles find_surface_files(const fs::path& folder, std::error_code& error) {
  SurfaceFiles found;
  for (fs::directory_iterator at(folder / surface_folder, error), end; !error && at != end; at.increment(error)) {
    const auto& path = at->path();
    if (lower_case(path.extension().string()) != ".vtp") continue;
    (path.filename().string().starts_with('.') ? found.ignored : found.files).push_back(path);
  }
  std::sort(found.files.begin(), found.files.end());
  return found;
}

SurfaceFiles surface_files(const fs::path& folder) {
  const auto surfaces = folder / surface_folder;
  std::error_code error;
  const auto found = find_surface_files(folder, error);
  if (error || found.files.empty())
    throw InputError(surfaces.string(),
                     error ? "cannot be read: " + error.message()
                           : fmt::format("holds no .vtp file{}", found.ignored.empty() ? "" : " but hidden ones"),
                     "export the mesh with its named faces (SimVascular: mesh-complete with mesh-surfaces)");
  for (std::size_t i = 1; i < found.files.size(); ++i)
    if (found.files[i].stem() == found.files[i - 1].stem())
      throw InputError(found.files[i].string(),
                       fmt::format("has the name of another face, {}", found.files[i - 1].filename().string()),
                       "keep one file for each face");
  return found;
}

/// The file of that name in the folder, whatever the case of its letters; the name as it is where there is none.
fs::path volume_file(const fs::path& folder) {
  const std::string name = volume_name;
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (lower_case(at->path().filename().string()) == name) return at->path();
  return folder / name;
}

}  // namespace

mesh::LoadedMesh read_simvascular(const fs::path& folder, mesh::RegionKind kind, const std::string& name,
                                  const SimVascularOptions& options) {
  const auto surfaces = surface_files(folder);
  MeshFiles files{volume_file(folder), {}, {}};
  for (const auto& path : surfaces.files) files.faces.emplace_back(path.stem().string(), path);
  auto mesh = read_mesh_files(files, kind, name, options);
  for (const auto& path : surfaces.ignored)
    mesh.report.insert(mesh.report.begin() + 1, fmt::format("{}: hidden file, ignored", path.string()));
  return mesh;
}

std::vector<fs::path> simvascular_files(const fs::path& folder) {
  std::error_code none;
  auto files = find_surface_files(folder, none).files;
  if (const auto volume = volume_file(folder); fs::is_regular_file(volume, none)) files.insert(files.begin(), volume);
  return files;
}

}  // namespace tunica::mesh_io
