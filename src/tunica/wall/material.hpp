// The list of wall laws. A new law is a file in materials/, an entry here and example parameters in the laws' test.
//
// A law in the list has, besides what the concept Material asks for, the struct Parameters that the case file fills
// (schema(), and a member ElasticConstants elastic), and from(Parameters), which prepares it for the kernels.
#pragma once

#include <concepts>
#include <variant>

#include "tunica/wall/materials/neo_hooke.hpp"

namespace tunica::wall {

using Law = std::variant<NeoHooke>;

template <class L>
concept ListedMaterial = Material<L> && requires(const typename L::Parameters& p) {
  { L::from(p) } -> std::same_as<L>;
  { L::Parameters::schema() } -> std::same_as<config::Schema<typename L::Parameters>>;
  { p.elastic } -> std::same_as<const ElasticConstants&>;
};

namespace detail {

template <class Variant>
struct Listed;
template <ListedMaterial... L>
struct Listed<std::variant<L...>> {
  using Parameters = std::variant<typename L::Parameters...>;

  static Law make(const Parameters& parameters) {
    Law law;
    // The alternatives of both variants stand in the same order.
    ((std::holds_alternative<typename L::Parameters>(parameters)
          ? void(law = L::from(std::get<typename L::Parameters>(parameters)))
          : void()),
     ...);
    return law;
  }
  static config::Schema<Parameters> schema() {
    config::Schema<Parameters> s("material", "Wall law.");
    s.one_of();
    (s.alternative(L::Parameters::schema()), ...);
    return s;
  }
};

}  // namespace detail

/// Parameters of one of the laws, as the case file gives them.
using LawParameters = detail::Listed<Law>::Parameters;

inline Law make_law(const LawParameters& parameters) { return detail::Listed<Law>::make(parameters); }
inline config::Schema<LawParameters> law_schema() { return detail::Listed<Law>::schema(); }
inline const ElasticConstants& elastic_constants(const LawParameters& parameters) {
  return std::visit([](const auto& p) -> const ElasticConstants& { return p.elastic; }, parameters);
}

}  // namespace tunica::wall
