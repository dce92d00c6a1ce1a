#include "tunica/wall/composition.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tunica::wall {

namespace {

void check_layers(const Layers& layers, config::Problems& problems) {
  if (layers.outwards.empty())
    problems.add("outwards", "names no layer", "add one, `{beyond: 0.6, material: ...}`, or remove `layers`");
  for (std::size_t i = 1; i < layers.outwards.size(); ++i) {
    const double from = layers.outwards[i - 1].beyond, to = layers.outwards[i].beyond;
    if (to - from < std::max(layers.blending, 1e-6))
      problems.add(fmt::format("outwards[{}].beyond", i),
                   fmt::format("is {:g} after {:g}, with a blending of {:g}", to, from, layers.blending),
                   "layers go from the inside outwards, each thicker than the blending");
  }
}

}  // namespace

config::Schema<Layer> Layer::schema() {
  return config::Schema<Layer>("layer", "A layer of the wall.")
      .number("beyond", &Layer::beyond, config::range(0.001, 0.999),
              "Depth at which it begins, 0 at the inner and 1 at the outer surface")
      .section("material", &Layer::material, law_schema(), "Law of the layer and its parameters");
}

config::Schema<Layers> Layers::schema() {
  return config::Schema<Layers>("layers", "Layers of the wall; `material` beside them is the innermost.")
      .text("depth", &Layers::depth,
            "Cell array, 0 at the inner and 1 at the outer surface, one value or one for each corner of an element; "
            "`tunica fibres` writes `depth`")
      .number("blending", &Layers::blending, config::range(0, 0.5),
              "Depth over which one layer turns into the next; 0: they jump")
      .by_default()
      .list("outwards", &Layers::outwards, Layer::schema(), "The layers from the second one, outwards")
      .check(check_layers);
}

config::Schema<Admixture> Admixture::schema() {
  return config::Schema<Admixture>("admixture", "A second material that takes a share.")
      .text("share", &Admixture::share, "Cell array, 0 where there is none of it, 1 where there is nothing else")
      .section("material", &Admixture::material, law_schema(), "Law of it and its parameters");
}

config::Schema<Composition> Composition::schema() {
  return config::Schema<Composition>("composition", "What the wall is made of beside its first material.")
      .section("layers", &Composition::layers, Layers::schema(), "Layers; `material` is the innermost one")
      .section("admixture", &Composition::admixture, Admixture::schema(),
               "A second material with a share that varies, such as calcified or weakened tissue");
}

std::vector<double> Layers::weights(double at_depth) const {
  std::vector<double> w{1.0};
  for (const Layer& layer : outwards) {
    const double beyond = at_depth - layer.beyond;
    const double part = blending > 0.0 ? std::clamp(beyond / blending + 0.5, 0.0, 1.0) : beyond > 0.0 ? 1.0 : 0.0;
    w.back() -= part;
    w.push_back(part);
  }
  for (double& weight : w) weight = std::max(weight, 0.0);
  return w;
}

std::vector<const LawParameters*> Composition::further() const {
  std::vector<const LawParameters*> result;
  if (layers)
    for (const Layer& layer : layers->outwards) result.push_back(&layer.material);
  if (admixture) result.push_back(&admixture->material);
  return result;
}

std::vector<std::string> Composition::arrays() const {
  std::vector<std::string> names;
  if (layers) names.push_back(layers->depth);
  if (admixture) names.push_back(admixture->share);
  return names;
}

std::vector<double> Composition::weights(double depth, double share) const {
  std::vector<double> w = layers ? layers->weights(depth) : std::vector<double>{1.0};
  if (!admixture) return w;
  for (double& weight : w) weight *= 1.0 - share;
  w.push_back(share);
  return w;
}

}  // namespace tunica::wall
