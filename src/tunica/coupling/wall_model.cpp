#include "tunica/coupling/wall_model.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/base/error.hpp"
#include "tunica/coupling/fibre_frames.hpp"
#include "tunica/coupling/material_weights.hpp"
#include "tunica/coupling/region_blending.hpp"

namespace tunica::coupling {

namespace {

/// Index of the material of each region of the mesh; -1 in the lumen.
std::vector<int> material_of_regions(const distributed::DistributedMesh& mesh, const wall::Parameters& parameters) {
  std::vector<std::string> known;
  std::string names;
  std::vector<int> material;
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::wall) {
      material.push_back(-1);
      continue;
    }
    known.push_back(region.name);
    names += (names.empty() ? "" : ", ") + region.name;
    const auto found = parameters.regions.find(region.name);
    material.push_back(
        found == parameters.regions.end() ? 0 : 1 + static_cast<int>(std::distance(parameters.regions.begin(), found)));
  }
  for (const auto& [name, unused] : parameters.regions)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError("wall.regions." + name, "the mesh has no wall region of this name", "use one of: " + names);
  return material;
}

/// The prestress that came with the elements of the mesh.
WallPrestress prestress_of_mesh(const distributed::DistributedMesh& mesh, wall::PrestressKind kind) {
  WallPrestress prestress{.kind = kind};
  for (const auto& region : mesh.regions) {
    auto& values = prestress.values.emplace_back();
    if (region.kind == mesh::RegionKind::wall) values = region.field(wall::prestress_array).values;
  }
  return prestress;
}

/// Its kind, by the number of components; none where the mesh has no such array.
wall::PrestressKind kind_in_mesh(const distributed::DistributedMesh& mesh) {
  for (const auto& region : mesh.regions)
    for (const auto& field : region.fields) {
      if (field.name != wall::prestress_array) continue;
      for (const auto kind : {wall::PrestressKind::stress, wall::PrestressKind::stretch})
        if (field.components == prestress_points(mesh.quadratic) * wall::components(kind)) return kind;
      throw std::invalid_argument("the prestress of the mesh has as many components as its elements need");
    }
  return wall::PrestressKind::none;
}

}  // namespace

WallModel::WallModel(const distributed::DistributedMesh& mesh, const wall::Parameters& parameters)
    : mixed_(parameters.element == wall::Element::mixed),
      volumetric_energy_(parameters.volumetric_energy),
      stabilisation_(parameters.stabilisation),
      points_(coupling::prestress_points(mesh.quadratic)) {
  bool anisotropic = false;
  const auto add = [&](const std::string& name, const wall::LawParameters& material, double density) {
    anisotropic |= wall::is_anisotropic(material);
    laws_.push_back(wall::make_law(material));
    densities_.push_back(density);
    bulk_moduli_.push_back(wall::bulk_modulus(material));
    shear_moduli_.push_back(wall::shear_modulus_at_rest(laws_.back()));
    for (const std::string& note : wall::notes(laws_.back())) notes_.push_back(name + ": " + note);
  };
  std::vector<const wall::Composition*> compositions;
  const auto add_all = [&](const std::string& name, const wall::LawParameters& material,
                           const wall::Composition& composition, double density) {
    add(name, material, density);
    for (const auto* further : composition.further()) add(name + ", further material", *further, density);
    compositions.push_back(&composition);
  };
  add_all("wall", parameters.material, parameters.composition, parameters.density);
  for (const auto& [name, region] : parameters.regions)
    add_all("wall region " + name, region.material, region.composition, region.density.value_or(parameters.density));

  weight_points_ = weight_points(mesh, compositions);
  const std::size_t rows = 1 + static_cast<std::size_t>(weight_points_);
  const auto shares =
      material_weights(mesh, compositions,
                       blend_regions(mesh, material_of_regions(mesh, parameters), static_cast<int>(compositions.size()),
                                     parameters.smoothing_length.value_or(0.0)));
  std::map<std::vector<std::size_t>, std::int32_t> known;
  regions_.resize(mesh.regions.size());
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    if (mesh.regions[r].kind != mesh::RegionKind::wall) continue;
    RegionModel& region = regions_[r];
    if (anisotropic) region.frames = fibre_frames(mesh, mesh.regions[r], parameters.fibre_frame.value());
    for (std::size_t e = 0; e < mesh.regions[r].elements.size(); ++e) {
      const double* weights = shares[r].data() + e * rows * laws_.size();
      std::vector<std::size_t> present;
      for (std::size_t m = 0; m < laws_.size(); ++m) {
        bool any = false;
        for (std::size_t k = 0; k < rows; ++k) any |= weights[k * laws_.size() + m] > 0.0;
        if (any) present.push_back(m);
      }
      region.weights.push_back(weights_.size());
      for (std::size_t k = 0; k < rows; ++k)
        for (const std::size_t m : present) weights_.push_back(weights[k * laws_.size() + m]);
      const auto [blend, is_new] = known.emplace(present, static_cast<std::int32_t>(blends_.size()));
      if (is_new) {
        Blend& b = blends_.emplace_back();
        b.materials = present;
        for (const std::size_t m : present) b.laws.push_back(&laws_[m]);
      }
      region.blend.push_back(blend->second);
      const Blend& b = blends_[static_cast<std::size_t>(blend->second)];
      region.present_modulus.push_back(blended(shear_moduli_, b, weights_.data() + region.weights[e]));
      for (std::size_t k = 1; k < rows; ++k)
        region.point_bulk_moduli.push_back(
            blended(bulk_moduli_, b, weights_.data() + region.weights[e] + k * present.size()));
    }
  }
  if (const auto kind = kind_in_mesh(mesh); kind != wall::PrestressKind::none)
    prestress_ = prestress_of_mesh(mesh, kind);
}

double WallModel::shear_modulus_at_rest() const {
  return *std::max_element(shear_moduli_.begin(), shear_moduli_.end());
}

double WallModel::blended(const std::vector<double>& of_material, const Blend& blend, const double* weights) const {
  if (blend.materials.size() == 1) return of_material[blend.materials[0]];
  double sum = 0.0;
  for (std::size_t i = 0; i < blend.materials.size(); ++i)
    if (weights[i] > 0.0) sum += weights[i] * of_material[blend.materials[i]];  // 0 of an infinite K is nothing
  return sum;
}

WallModel::ElementMaterial WallModel::material(std::size_t region, std::int32_t element) const {
  const Blend& blend = blends_[regions_[region].blend[element]];
  const double* weights = weights_.data() + regions_[region].weights[element];
  ElementMaterial m;
  m.law.laws = blend.laws;
  if (blend.laws.size() > 1) {
    m.law.weights = weights;
    if (weight_points_ > 0) m.law.point_weights = weights + blend.laws.size();
  }
  m.law.shear_modulus = blended(shear_moduli_, blend, weights);
  m.law.stabilising_modulus = regions_[region].present_modulus[element];
  m.body = {.density = blended(densities_, blend, weights),
            .volumetric = {volumetric_energy_, blended(bulk_moduli_, blend, weights)},
            .stabilisation = stabilisation_};
  if (weight_points_ > 0)
    m.body.bulk_moduli = regions_[region].point_bulk_moduli.data() +
                         static_cast<std::ptrdiff_t>(element) * static_cast<std::ptrdiff_t>(weight_points_);
  return m;
}

WallModel::ElementMaterial WallModel::material(std::size_t region, std::int32_t element, int point) const {
  const auto m = material(region, element);
  return {m.law.at_point(point), m.body.at_point(point)};
}

double WallModel::weight(std::size_t region, std::int32_t element, std::size_t material) const {
  const auto& present = blends_[regions_[region].blend[element]].materials;
  const auto found = std::find(present.begin(), present.end(), material);
  if (found == present.end()) return 0.0;
  return weights_[regions_[region].weights[element] + static_cast<std::size_t>(found - present.begin())];
}

wall::ElementState<double> WallModel::imaged(std::size_t region, std::int32_t element,
                                             const Vec3<double> (&X)[4]) const {
  wall::ElementState<double> state{};
  if (regions_[region].frames.empty()) {
    wall::set_reference(state, X);
  } else {
    const double* frame = regions_[region].frames.data() + 6 * static_cast<std::size_t>(element);
    wall::set_reference(state, X, Vec3<double>{{frame[0], frame[1], frame[2]}},
                        Vec3<double>{{frame[3], frame[4], frame[5]}});
  }
  return state;
}

wall::ElementState<double> WallModel::at_rest(std::size_t region, std::int32_t element,
                                              const Vec3<double> (&X)[4]) const {
  auto state = imaged(region, element, X);
  if (prestress_.kind == wall::PrestressKind::stretch) wall::set_prestretch(state, prestretch(region, element, 0));
  return state;
}

Mat3<double> WallModel::axes(std::size_t region, std::int32_t element) const {
  if (regions_[region].frames.empty()) return identity<double>();
  const double* f = regions_[region].frames.data() + 6 * static_cast<std::size_t>(element);
  const Vec3<double> e1{{f[0], f[1], f[2]}}, e2{{f[3], f[4], f[5]}}, e3 = cross(e1, e2);
  return {{{e1[0], e2[0], e3[0]}, {e1[1], e2[1], e3[1]}, {e1[2], e2[2], e3[2]}}};
}

const double* WallModel::prestress_at(std::size_t region, std::int32_t element, int point) const {
  return prestress_.values[region].data() + static_cast<std::ptrdiff_t>(wall::components(prestress_.kind)) *
                                                (static_cast<std::ptrdiff_t>(element) * points_ + point);
}

wall::Symmetric<double> WallModel::prestress(std::size_t region, std::int32_t element, int point) const {
  wall::Symmetric<double> S0{};
  if (prestress_.kind != wall::PrestressKind::stress) return S0;
  const double* v = prestress_at(region, element, point);
  for (int k = 0; k < wall::voigt_size; ++k) S0[k] = v[k];
  return wall::in_axes(axes(region, element), S0);
}

Mat3<double> WallModel::prestretch(std::size_t region, std::int32_t element, int point) const {
  const double* v = prestress_at(region, element, point);
  Mat3<double> F0;
  for (int k = 0; k < 9; ++k) F0(k / 3, k % 3) = v[k];
  const Mat3<double> Q = axes(region, element);
  return transpose(Q) * F0 * Q;
}

wall::quadratic::PointPrestress<double> WallModel::point_prestress(std::size_t region, std::int32_t element) const {
  wall::quadratic::PointPrestress<double> result{};
  result.kind = prestress_.kind;
  for (int q = 0; q < wall::quadratic::points; ++q) {
    if (result.kind == wall::PrestressKind::stress) result.stress[q] = prestress(region, element, q);
    if (result.kind == wall::PrestressKind::stretch) result.stretch[q] = prestretch(region, element, q);
  }
  return result;
}

void WallModel::fill_prestress(Group& group) const {
  group.prestress.clear(), group.prestretch.clear();
  if (prestress_.kind == wall::PrestressKind::none) return;
  const bool stress = prestress_.kind == wall::PrestressKind::stress;
  const auto n = static_cast<std::size_t>(wall::components(prestress_.kind)),
             points = static_cast<std::size_t>(points_);
  const auto width = static_cast<std::size_t>(group.batches.width),
             batches = static_cast<std::size_t>(group.batches.batches());
  std::vector<double>& to = stress ? group.prestress : group.prestretch;
  to.resize(batches * points * n * width);
  const auto& members = group.batches.elements_of_region;
  for (std::size_t lane = 0; lane < batches * width; ++lane) {
    const auto element = members[std::min(lane, members.size() - 1)];
    for (std::size_t q = 0; q < points; ++q) {
      double* values = to.data() + (lane / width * points + q) * n * width + lane % width;
      if (stress) {
        const auto S0 = prestress(group.region, element, static_cast<int>(q));
        for (std::size_t c = 0; c < n; ++c) values[c * width] = S0[static_cast<int>(c)];
      } else {
        const auto F0 = prestretch(group.region, element, static_cast<int>(q));
        for (std::size_t c = 0; c < n; ++c) values[c * width] = F0(static_cast<int>(c) / 3, static_cast<int>(c) % 3);
      }
    }
  }
}

void WallModel::set_prestress(WallPrestress prestress, std::vector<Group>& groups) {
  const auto n = static_cast<std::size_t>(wall::components(prestress.kind) * points_);
  for (std::size_t r = 0; r < regions_.size() && n > 0; ++r)
    if (prestress.values.size() != regions_.size() || prestress.values[r].size() != n * regions_[r].blend.size())
      throw std::invalid_argument("set_prestress: as many values as the wall elements need");
  prestress_ = std::move(prestress);
  for (Group& group : groups) fill_prestress(group);
}

WallGroupView WallModel::Group::view() const {
  return {.batches = BatchView(batches),
          .kind = kind,
          .laws = laws,
          .weights = weights.empty() ? nullptr : weights.data(),
          .point_weights = point_weights.empty() ? nullptr : point_weights.data(),
          .point_bulk_moduli = point_bulk_moduli.empty() ? nullptr : point_bulk_moduli.data(),
          .bodies = bodies.data(),
          .frames = frames.empty() ? nullptr : frames.data(),
          .prestress = prestress.empty() ? nullptr : prestress.data(),
          .prestretch = prestretch.empty() ? nullptr : prestretch.data()};
}

WallElementSettings WallModel::element_settings() const { return {mixed_, volumetric_energy_, stabilisation_}; }

std::vector<WallModel::Group> WallModel::groups(const distributed::DistributedMesh& mesh, std::size_t region,
                                                const assembly::BlockPattern& pattern, int width) const {
  const RegionModel& model = regions_[region];
  std::vector<Group> result;
  for (const bool split : {false, true}) {
    std::map<std::int32_t, std::vector<std::int32_t>> elements;
    for (const auto e : assembly::elements_beside_hosts(mesh, mesh.regions[region], split))
      elements[model.blend[e]].push_back(e);
    for (auto& [b, list] : elements) {
      const Blend& blend = blends_[b];
      Group group;
      group.region = region;
      group.batches = make_batches(mesh, mesh.regions[region], std::move(list), pattern, width, split);
      group.kind = wall::kind_of(blend.laws);
      const bool at_points = weight_points_ > 0 && blend.laws.size() > 1;
      // One neo-Hookean law stands for a blend of several only where their weights are the same at all points.
      if (at_points && group.kind == wall::LawKind::linear) group.kind = wall::LawKind::isochoric;
      group.laws = blend.laws;
      const auto& members = group.batches.elements_of_region;
      for (std::int32_t batch = 0; batch < group.batches.batches(); ++batch) {
        const auto add = [&](std::vector<double>& to, const auto& value) {
          for (int lane = 0; lane < width; ++lane)
            to.push_back(value(
                members[std::min<std::size_t>(static_cast<std::size_t>(batch) * width + lane, members.size() - 1)]));
        };
        const auto weights = [&](std::int32_t e) { return weights_.data() + model.weights[e]; };
        if (blend.laws.size() > 1)
          for (std::size_t i = 0; i < blend.laws.size(); ++i)
            add(group.weights, [&](std::int32_t e) { return weights(e)[i]; });
        const auto points = static_cast<std::size_t>(at_points ? weight_points_ : 0);
        for (std::size_t q = 0; q < points; ++q) {
          for (std::size_t i = 0; i < blend.laws.size(); ++i)
            add(group.point_weights, [&](std::int32_t e) { return weights(e)[(1 + q) * blend.laws.size() + i]; });
          add(group.point_bulk_moduli,
              [&](std::int32_t e) { return model.point_bulk_moduli[static_cast<std::size_t>(e) * points + q]; });
        }
        for (const auto* property : {&densities_, &bulk_moduli_, &shear_moduli_})
          add(group.bodies, [&](std::int32_t e) { return blended(*property, blend, weights(e)); });
        add(group.bodies, [&](std::int32_t e) { return model.present_modulus[e]; });
        if (!model.frames.empty())
          for (std::size_t c = 0; c < 6; ++c)
            add(group.frames, [&](std::int32_t e) { return model.frames[6 * static_cast<std::size_t>(e) + c]; });
      }
      fill_prestress(group);
      result.push_back(std::move(group));
    }
  }
  return result;
}

void WallModel::update_present_modulus(std::vector<Group>& groups, const FieldsView& fields, assembly::Isa isa) {
  if (!mixed_) return;
  const auto width = static_cast<std::size_t>(isa);
  std::vector<double> modulus;
  for (Group& group : groups) {
    if (group.kind == wall::LawKind::linear || group.batches.nodes_per_element != fe::nodes) continue;
    const auto& members = group.batches.elements_of_region;
    modulus.resize(static_cast<std::size_t>(group.batches.batches()) * width);
    element_loops(isa).wall.modulus(group.view(), fields, modulus.data());
    for (std::size_t k = 0; k < modulus.size(); ++k) group.bodies[(k / width * 4 + 3) * width + k % width] = modulus[k];
    for (std::size_t k = 0; k < members.size(); ++k) regions_[group.region].present_modulus[members[k]] = modulus[k];
  }
}

}  // namespace tunica::coupling
