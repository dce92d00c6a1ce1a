// A tetrahedral mesh that can be changed locally: every node knows its elements.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tunica/geometry/tetrahedra.hpp"

namespace tunica::meshing {

/// Smallest sine of the six dihedral angles: 0 for a flat element, negative for an inverted one, at most 0.943.
double worst_sine(const geometry::Point& a, const geometry::Point& b, const geometry::Point& c,
                  const geometry::Point& d);

class LocalMesh {
 public:
  using Node = std::int32_t;
  using Cell = std::int32_t;
  using Corners = std::array<Node, 4>;

  explicit LocalMesh(const geometry::Tetrahedra& mesh);
  geometry::Tetrahedra extract() const;

  Cell cells() const { return static_cast<Cell>(corners_.size()); }  ///< removed ones included
  bool alive(Cell c) const { return labels_[c] >= 0; }
  const Corners& corners(Cell c) const { return corners_[c]; }
  int label(Cell c) const { return labels_[c]; }
  double sine(Cell c) const { return sines_[c]; }
  const std::vector<Cell>& star(Node n) const { return stars_[n]; }
  const geometry::Point& point(Node n) const { return points_[n]; }

  enum class Place : char { inner, surface, curve };
  Place place(Node n) const { return places_[n]; }
  /// Labels on either side of a surface node; outside = 0 is the second.
  std::array<int, 2> sides(Node n) const { return sides_[n]; }
  /// Triangles of the surface at a surface node, counter-clockwise seen from the second side.
  std::vector<std::array<Node, 3>> faces_at(Node n) const;
  /// Unit normal of the surface at a surface node, from the first side to the second.
  geometry::Point normal(Node n) const;

  /// Smallest sine in the star of `n` with the node at `p`; may stop early at any value below `enough`.
  double star_sine(Node n, const geometry::Point& p, double enough) const;
  void move(Node n, const geometry::Point& p);

  struct NewCell {
    Corners corners;
    int label;
  };
  /// Puts `fresh` in the place of `old`, which fill the same space.
  void replace(const std::vector<Cell>& old, const std::vector<NewCell>& fresh);

  /// The elements around an edge in order, each with the node before and after it; open at the outside.
  struct Ring {
    std::vector<Cell> cells;
    std::vector<Node> nodes;  ///< as many as cells when closed, one more when open
    bool closed;
  };
  /// None when the edge touches itself in a way that is no simple ring.
  std::optional<Ring> ring(Node a, Node b) const;
  bool is_edge(Node a, Node b) const;
  /// The element across the face opposite to corner `f`; -1: none.
  Cell across(Cell c, int f) const;

  /// Halves the edge; the new node lies on a surface or curve where the edge does. Returns the node.
  Node split(Node a, Node b);
  double cell_sine(const Corners& c) const {
    return worst_sine(points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]]);
  }

 private:
  void find_places(const geometry::Tetrahedra& mesh);

  std::vector<geometry::Point> points_;
  std::vector<Corners> corners_;
  std::vector<std::int8_t> labels_;  // -1: removed
  std::vector<float> sines_;
  std::vector<std::vector<Cell>> stars_;
  std::vector<Place> places_;
  std::vector<std::array<int, 2>> sides_;
  std::vector<Cell> unused_;
};

}  // namespace tunica::meshing
