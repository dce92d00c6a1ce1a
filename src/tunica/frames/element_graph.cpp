#include "tunica/frames/element_graph.hpp"

#include <algorithm>
#include <cassert>

#include "tunica/mesh/boundary.hpp"
#include "tunica/parallel/all_to_all.hpp"

namespace tunica::frames {

namespace {

using Triple = std::array<std::int64_t, 3>;

Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// A side of an element that this rank sees, under the global numbers of its nodes; or a triangle of a named face.
struct Side {
  Triple nodes;
  std::int64_t id;      ///< of the element; -1 - face for a triangle
  std::int32_t number;  ///< of the side
  int owner;            ///< of the element
  auto operator<=>(const Side&) const = default;
};

/// What the owner of element `id` learns of one of its sides.
struct Message {
  std::int64_t id, other;  ///< other: the element there, or -1 - face
  std::int32_t side;
  int other_owner;
};

/// All sides whose lowest node this rank owns: it sees everything that touches them.
class Sides {
 public:
  explicit Sides(const distributed::DistributedMesh& mesh) : mesh_(mesh) {
    first_.resize(static_cast<std::size_t>(parallel::size(mesh.comm)));
    MPI_Allgather(&mesh.first_global, 1, MPI_INT64_T, first_.data(), 1, MPI_INT64_T, mesh.comm);
    for (const auto& region : mesh.regions)
      if (region.kind == mesh::RegionKind::wall)
        for (std::size_t e = 0; e < region.elements.size(); ++e) add(region.elements[e], region.element_ids[e]);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      if (mesh.regions[mesh.faces[f].region].kind == mesh::RegionKind::wall)
        for (const auto& t : mesh.faces[f].triangles)
          add(t[0], t[1], t[2], {{}, -1 - static_cast<std::int64_t>(f), 0, 0});
    std::sort(sides_.begin(), sides_.end());
  }

  /// For each rank what it needs to know.
  std::vector<std::vector<Message>> messages() const {
    std::vector<std::vector<Message>> to(first_.size());
    const auto tell = [&](const Side& side, const Side& other) {
      if (side.id >= 0) to[side.owner].push_back({side.id, other.id, side.number, other.owner});
    };
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (i + 1 == sides_.size() || sides_[i].nodes != sides_[i + 1].nodes) continue;
      tell(sides_[i], sides_[i + 1]);
      tell(sides_[i + 1], sides_[i]);
      ++i;
    }
    return to;
  }

 private:
  void add(const std::array<std::int32_t, 4>& element, std::int64_t id) {
    std::int64_t lowest = mesh_.global_ids[element[0]];
    for (const auto n : element) lowest = std::min(lowest, mesh_.global_ids[n]);
    const auto owner = static_cast<int>(std::upper_bound(first_.begin(), first_.end(), lowest) - first_.begin()) - 1;
    for (int f = 0; f < 4; ++f) {
      const auto& corner = mesh::tetrahedron_faces[f];
      add(element[corner[0]], element[corner[1]], element[corner[2]], {{}, id, f, owner});
    }
  }

  void add(std::int32_t a, std::int32_t b, std::int32_t c, Side side) {
    side.nodes = sorted({mesh_.global_ids[a], mesh_.global_ids[b], mesh_.global_ids[c]});
    if (side.nodes[0] >= mesh_.first_global && side.nodes[0] < mesh_.first_global + mesh_.owned_nodes)
      sides_.push_back(side);
  }

  const distributed::DistributedMesh& mesh_;
  std::vector<std::int64_t> first_;  ///< first global node of each rank
  std::vector<Side> sides_;
};

/// Positions of owned elements by their numbers in MeshData.
class LocalNumbers {
 public:
  explicit LocalNumbers(const std::vector<std::int64_t>& ids) {
    for (std::size_t e = 0; e < ids.size(); ++e) sorted_.emplace_back(ids[e], static_cast<std::int32_t>(e));
    std::sort(sorted_.begin(), sorted_.end());
  }
  std::int32_t operator()(std::int64_t id) const {
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{id, std::int32_t{0}});
    assert(found != sorted_.end() && found->first == id);
    return found->second;
  }

 private:
  std::vector<std::pair<std::int64_t, std::int32_t>> sorted_;
};

}  // namespace

ElementGraph::ElementGraph(const distributed::DistributedMesh& mesh) : mesh_(mesh) {
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const auto& region = mesh.regions[r];
    if (region.kind != mesh::RegionKind::wall) continue;
    nodes_.insert(nodes_.end(), region.elements.begin(), region.elements.begin() + region.owned_elements);
    ids_.insert(ids_.end(), region.element_ids.begin(), region.element_ids.begin() + region.owned_elements);
    region_.insert(region_.end(), region.owned_elements, static_cast<std::int32_t>(r));
  }
  connect();
}

void ElementGraph::connect() {
  const LocalNumbers local(ids_);
  const int rank = parallel::rank(mesh_.comm);
  std::vector<std::vector<std::int64_t>> other(ids_.size());  // neighbours by their numbers in MeshData
  std::vector<std::vector<std::int64_t>> ghosts(static_cast<std::size_t>(parallel::size(mesh_.comm)));  // by owner
  face_.assign(4 * ids_.size(), -1);
  for (const auto& from : parallel::all_to_all(mesh_.comm, Sides(mesh_).messages()))
    for (const Message& m : from) {
      const auto e = local(m.id);
      if (m.other < 0) {
        face_[4 * static_cast<std::size_t>(e) + m.side] = static_cast<std::int32_t>(-1 - m.other);
        continue;
      }
      other[e].push_back(m.other);
      if (m.other_owner != rank) ghosts[m.other_owner].push_back(m.other);
    }
  const auto ghost_numbers = number_ghosts(std::move(ghosts));

  begin_ = {0};
  for (auto& ids : other) {
    std::sort(ids.begin(), ids.end());
    for (const auto id : ids) {
      const auto ghost = ghost_numbers.find(id);
      neighbours_.push_back(ghost == ghost_numbers.end() ? local(id) : ghost->second);
    }
    begin_.push_back(static_cast<std::int32_t>(neighbours_.size()));
  }
}

// Elements have global numbers that are contiguous on each rank, as the halo wants them; owners tell those of ghosts.
std::map<std::int64_t, std::int32_t> ElementGraph::number_ghosts(std::vector<std::vector<std::int64_t>> wanted) {
  for (auto& ids : wanted) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }
  const std::int64_t count = owned();
  std::int64_t first = 0;
  MPI_Scan(&count, &first, 1, MPI_INT64_T, MPI_SUM, mesh_.comm);
  first -= count;
  const LocalNumbers local(ids_);
  auto asked = parallel::all_to_all(mesh_.comm, wanted);
  for (auto& ids : asked)
    for (auto& id : ids) id = first + local(id);
  const auto answers = parallel::all_to_all(mesh_.comm, asked);

  std::vector<std::pair<std::int64_t, std::int64_t>> ghosts;  // global number, number in MeshData
  for (std::size_t r = 0; r < wanted.size(); ++r)
    for (std::size_t k = 0; k < wanted[r].size(); ++k) ghosts.emplace_back(answers[r][k], wanted[r][k]);
  std::sort(ghosts.begin(), ghosts.end());
  std::vector<std::int64_t> global(ids_.size());
  std::iota(global.begin(), global.end(), first);
  std::map<std::int64_t, std::int32_t> numbers;
  for (const auto& [global_number, id] : ghosts) {
    numbers[id] = static_cast<std::int32_t>(global.size());
    global.push_back(global_number);
  }
  size_ = static_cast<std::int32_t>(global.size());
  halo_ = parallel::Halo(mesh_.comm, global, owned(), first);
  return numbers;
}

Vec3<double> ElementGraph::area_vector(std::int32_t e, int side) const {
  const auto& corner = mesh::tetrahedron_faces[side];
  return mesh::area_vector(mesh_.points, std::array{nodes_[e][corner[0]], nodes_[e][corner[1]], nodes_[e][corner[2]]});
}

}  // namespace tunica::frames
