#include "tunica/coupling/wall_model.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/coupling/fibre_frames.hpp"
#include "tunica/coupling/region_blending.hpp"

namespace tunica::coupling {

namespace {

/// Index of the material of each region of the mesh; -1 in the lumen.
std::vector<int> material_of_regions(const mesh::DistributedMesh& mesh, const wall::Parameters& parameters) {
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

}  // namespace

WallModel::WallModel(const mesh::DistributedMesh& mesh, const wall::Parameters& parameters)
    : mixed_(parameters.element == wall::Element::mixed),
      volumetric_energy_(parameters.volumetric_energy),
      stabilisation_(parameters.stabilisation) {
  const auto add = [&](const std::string& name, const wall::LawParameters& material, double density) {
    laws_.push_back(wall::make_law(material));
    densities_.push_back(density);
    bulk_moduli_.push_back(wall::bulk_modulus(material));
    shear_moduli_.push_back(wall::shear_modulus_at_rest(laws_.back()));
    for (const std::string& note : wall::notes(laws_.back())) notes_.push_back(name + ": " + note);
  };
  add("wall", parameters.material, parameters.density);
  bool anisotropic = wall::is_anisotropic(parameters.material);
  for (const auto& [name, region] : parameters.regions) {
    add("wall region " + name, region.material, region.density.value_or(parameters.density));
    anisotropic |= wall::is_anisotropic(region.material);
  }

  const auto blending = blend_regions(mesh, material_of_regions(mesh, parameters), static_cast<int>(laws_.size()),
                                      parameters.smoothing_length.value_or(0.0));
  std::map<std::vector<std::size_t>, std::int32_t> known;
  regions_.resize(mesh.regions.size());
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    if (mesh.regions[r].kind != mesh::RegionKind::wall) continue;
    RegionModel& region = regions_[r];
    if (anisotropic) region.frames = fibre_frames(mesh, mesh.regions[r], parameters.fibre_frame.value());
    for (std::size_t e = 0; e < mesh.regions[r].elements.size(); ++e) {
      const double* weights = blending[r].data() + e * laws_.size();
      std::vector<std::size_t> present;
      region.weights.push_back(weights_.size());
      for (std::size_t m = 0; m < laws_.size(); ++m)
        if (weights[m] > 0.0) {
          present.push_back(m);
          weights_.push_back(weights[m]);
        }
      const auto [blend, is_new] = known.emplace(present, static_cast<std::int32_t>(blends_.size()));
      if (is_new) {
        Blend& b = blends_.emplace_back();
        b.materials = present;
        for (const std::size_t m : present) b.laws.push_back(&laws_[m]);
      }
      region.blend.push_back(blend->second);
      region.present_modulus.push_back(
          blended(shear_moduli_, blends_[blend->second], weights_.data() + region.weights[e]));
    }
  }
}

double WallModel::shear_modulus_at_rest() const {
  return *std::max_element(shear_moduli_.begin(), shear_moduli_.end());
}

double WallModel::blended(const std::vector<double>& of_material, const Blend& blend, const double* weights) const {
  if (blend.materials.size() == 1) return of_material[blend.materials[0]];
  double sum = 0.0;
  for (std::size_t i = 0; i < blend.materials.size(); ++i) sum += weights[i] * of_material[blend.materials[i]];
  return sum;
}

WallModel::ElementMaterial WallModel::material(std::size_t region, std::int32_t element) const {
  const Blend& blend = blends_[regions_[region].blend[element]];
  const double* weights = weights_.data() + regions_[region].weights[element];
  ElementMaterial m;
  m.law.laws = blend.laws;
  m.law.weights = blend.laws.size() == 1 ? nullptr : weights;
  m.law.shear_modulus = blended(shear_moduli_, blend, weights);
  m.law.stabilising_modulus = regions_[region].present_modulus[element];
  m.body = {.density = blended(densities_, blend, weights),
            .volumetric = {volumetric_energy_, blended(bulk_moduli_, blend, weights)},
            .stabilisation = stabilisation_};
  return m;
}

double WallModel::weight(std::size_t region, std::int32_t element, std::size_t material) const {
  const auto& present = blends_[regions_[region].blend[element]].materials;
  const auto found = std::find(present.begin(), present.end(), material);
  if (found == present.end()) return 0.0;
  return weights_[regions_[region].weights[element] + static_cast<std::size_t>(found - present.begin())];
}

wall::ElementState<double> WallModel::at_rest(std::size_t region, std::int32_t element,
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

WallGroupView WallModel::Group::view() const {
  return {.batches = BatchView(batches),
          .kind = kind,
          .laws = laws,
          .weights = weights.empty() ? nullptr : weights.data(),
          .bodies = bodies.data(),
          .frames = frames.empty() ? nullptr : frames.data()};
}

WallElementSettings WallModel::element_settings() const { return {mixed_, volumetric_energy_, stabilisation_}; }

std::vector<WallModel::Group> WallModel::groups(const mesh::DistributedMesh& mesh, std::size_t region,
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
        for (const auto* property : {&densities_, &bulk_moduli_, &shear_moduli_})
          add(group.bodies, [&](std::int32_t e) { return blended(*property, blend, weights(e)); });
        add(group.bodies, [&](std::int32_t e) { return model.present_modulus[e]; });
        if (!model.frames.empty())
          for (std::size_t c = 0; c < 6; ++c)
            add(group.frames, [&](std::int32_t e) { return model.frames[6 * static_cast<std::size_t>(e) + c]; });
      }
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
    if (group.kind == wall::LawKind::linear) continue;
    const auto& members = group.batches.elements_of_region;
    modulus.resize(static_cast<std::size_t>(group.batches.batches()) * width);
    element_loops(isa).wall.modulus(group.view(), fields, modulus.data());
    for (std::size_t k = 0; k < modulus.size(); ++k) group.bodies[(k / width * 4 + 3) * width + k % width] = modulus[k];
    for (std::size_t k = 0; k < members.size(); ++k) regions_[group.region].present_modulus[members[k]] = modulus[k];
  }
}

}  // namespace tunica::coupling
