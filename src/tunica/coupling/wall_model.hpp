// What the wall is made of: prepared laws, the blend of materials and the fibre frame of every element.
#pragma once

#include <map>
#include <vector>

#include "tunica/assembly/element_batches.hpp"
#include "tunica/coupling/element_loops.hpp"
#include "tunica/coupling/wall_prestress.hpp"
#include "tunica/wall/blended_law.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {

class WallModel {
 public:
  /// Prestress is taken from the mesh where it has the array (wall::prestress_array). Throws InputError when a region
  /// of the parameters is not in the mesh, a frame or an array cannot be found, or the rule of fibre directions cannot
  /// keep its tolerance. Collective.
  WallModel(const distributed::DistributedMesh& mesh, const wall::Parameters& parameters);

  bool mixed() const { return mixed_; }

  /// What a log should say of the laws: one line each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// [Pa] the largest of the materials.
  double shear_modulus_at_rest() const;

  /// Law and body of one element; refers to this model.
  struct ElementMaterial {
    wall::UnsplitBlendedLaw<double> law;
    wall::Body body;
  };
  ElementMaterial material(std::size_t region, std::int32_t element) const;
  /// At a point (prestress_points): of quadratic elements in layers, materials have another share at each.
  ElementMaterial material(std::size_t region, std::int32_t element, int point) const;

  /// The element with the corners X [m] in the imaged shape: gradients in its fibre frame, or in global axes where no
  /// law needs one.
  wall::ElementState<double> imaged(std::size_t region, std::int32_t element, const Vec3<double> (&X)[4]) const;
  /// The same of a linear element, referred to its stress-free state where it is prestretched.
  wall::ElementState<double> at_rest(std::size_t region, std::int32_t element, const Vec3<double> (&X)[4]) const;

  /// e1 and e2 of the fibre frame of each element of a region, [element][6]; empty where no law needs one.
  const std::vector<double>& frames(std::size_t region) const { return regions_[region].frames; }

  const WallPrestress& prestress() const { return prestress_; }
  /// S0 of an element at a point (prestress_points) in the axes of its gradients [Pa]; zero without.
  wall::Symmetric<double> prestress(std::size_t region, std::int32_t element, int point) const;
  /// Prestress of a quadratic element.
  wall::quadratic::PointPrestress<double> point_prestress(std::size_t region, std::int32_t element) const;
  int prestress_points() const { return points_; }

  /// Weight of a material in an element: 0 is that of all regions without one of their own, then what else they are
  /// composed of (wall::Composition::further), then the same of the other regions by name.
  double weight(std::size_t region, std::int32_t element, std::size_t material) const;
  std::size_t materials() const { return laws_.size(); }

  /// Elements of equal materials in batches, with what the loops need of them.
  struct Group {
    assembly::ElementBatches batches;
    wall::LawKind kind;
    std::vector<const wall::Law*> laws;
    std::size_t region;           ///< of the mesh
    std::vector<double> weights;  ///< [batch][law][lane], empty for one law
    /// [batch][point][law][lane] and K [batch][point][lane]; empty where they are the same at all points.
    std::vector<double> point_weights, point_bulk_moduli;
    std::vector<double> bodies;  ///< [batch][density, K, mu at rest, mu present][lane]
    std::vector<double> frames;  ///< [batch][6][lane], empty without frames
    /// Of the kind that the model has [batch][point][component][lane], axes of the frames; empty without.
    std::vector<double> prestress, prestretch;

    WallGroupView view() const;
  };
  std::vector<Group> groups(const distributed::DistributedMesh& mesh, std::size_t region,
                            const assembly::BlockPattern& pattern, int width) const;
  WallElementSettings element_settings() const;

  /// Prestress from now on, also in the groups, which must be this model's. Throws std::invalid_argument for a wrong
  /// number of values.
  void set_prestress(WallPrestress prestress, std::vector<Group>& groups);

  /// Takes the present modulus (1.16) of all elements from the displacement in `fields`, for the groups, which must be
  /// this model's, and for material(). Only the stabilisation of the linear mixed element depends on it; quadratic
  /// elements keep the modulus at rest.
  void update_present_modulus(std::vector<Group>& groups, const FieldsView& fields, assembly::Isa isa);

 private:
  struct Blend {
    std::vector<std::size_t> materials;
    std::vector<const wall::Law*> laws;
  };
  struct RegionModel {
    std::vector<std::int32_t> blend;  ///< [element] in blends_
    /// [element] begin in weights_: of one law for each material, [centroid, then weight_points_][material].
    std::vector<std::size_t> weights;
    std::vector<double> point_bulk_moduli;  ///< [element][weight_points_] [Pa]
    std::vector<double> frames;
    std::vector<double> present_modulus;  ///< [element] [Pa]
  };
  /// Axes of the gradients of an element, before any prestretch.
  Mat3<double> axes(std::size_t region, std::int32_t element) const;
  Mat3<double> prestretch(std::size_t region, std::int32_t element, int point) const;
  const double* prestress_at(std::size_t region, std::int32_t element, int point) const;
  void fill_prestress(Group& group) const;
  double blended(const std::vector<double>& of_material, const Blend& blend, const double* weights) const;

  bool mixed_;
  wall::VolumetricEnergy volumetric_energy_;
  double stabilisation_;
  std::vector<wall::Law> laws_;
  std::vector<double> densities_, bulk_moduli_, shear_moduli_;  ///< [material]
  std::vector<std::string> notes_;
  std::vector<Blend> blends_;
  std::vector<double> weights_;
  std::vector<RegionModel> regions_;  ///< [region of the mesh], empty for the lumen
  WallPrestress prestress_;
  int points_;             ///< of an element that have a prestress each
  int weight_points_ = 0;  ///< of an element at which materials have a weight each
};

}  // namespace tunica::coupling
