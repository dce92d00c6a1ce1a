#include "tunica/coupling/whole_face.hpp"

#include <algorithm>

namespace tunica::coupling {

namespace {

struct Corner {
  std::int64_t node;
  double x[3];
};

std::vector<Corner> all_corners(const distributed::DistributedMesh& mesh, const distributed::Face& face) {
  std::vector<Corner> mine;
  for (std::int32_t t = 0; t < face.owned_triangles; ++t)
    for (const auto* nodes : {&face.triangles[t], mesh.quadratic ? &face.edges[t] : nullptr})
      for (int a = 0; a < 3 && nodes != nullptr; ++a) {
        const auto& x = mesh.points[(*nodes)[a]];
        mine.push_back({mesh.global_ids[(*nodes)[a]], {x[0], x[1], x[2]}});
      }
  int ranks = 1;
  MPI_Comm_size(mesh.comm, &ranks);
  const int bytes = static_cast<int>(mine.size() * sizeof(Corner));
  std::vector<int> sizes(ranks), offsets(ranks, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, mesh.comm);
  for (int r = 1; r < ranks; ++r) offsets[r] = offsets[r - 1] + sizes[r - 1];
  std::vector<Corner> all(static_cast<std::size_t>(offsets.back() + sizes.back()) / sizeof(Corner));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), sizes.data(), offsets.data(), MPI_BYTE, mesh.comm);
  return all;
}

}  // namespace

std::int32_t WholeFace::find(std::int64_t global_id) const {
  const auto it = std::lower_bound(global_ids.begin(), global_ids.end(), global_id);
  return it == global_ids.end() || *it != global_id ? -1 : static_cast<std::int32_t>(it - global_ids.begin());
}

WholeFace gather_face(const distributed::DistributedMesh& mesh, const distributed::Face& face) {
  const auto corners = all_corners(mesh, face);
  WholeFace whole;
  whole.name = face.name;
  for (const auto& corner : corners) whole.global_ids.push_back(corner.node);
  std::sort(whole.global_ids.begin(), whole.global_ids.end());
  whole.global_ids.erase(std::unique(whole.global_ids.begin(), whole.global_ids.end()), whole.global_ids.end());
  whole.points.resize(whole.global_ids.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto node = whole.find(corners[k].node);
    whole.points[node] = {{corners[k].x[0], corners[k].x[1], corners[k].x[2]}};
    auto& cells = mesh.quadratic && k % 6 >= 3 ? whole.edges : whole.triangles;
    if (k % 3 == 0) cells.emplace_back();
    cells.back()[k % 3] = node;
  }
  return whole;
}

}  // namespace tunica::coupling
