// A law with values to be found, beside all that was measured: the residuals of a fit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/fitting/law_template.hpp"
#include "tunica/fitting/least_squares.hpp"
#include "tunica/fitting/protocol.hpp"
#include "tunica/wall/materials/dfd_directions.hpp"

namespace tunica::fitting {

/// One number that is searched: a parameter, or that of one specimen.
struct Unknown {
  std::size_t parameter;
  std::optional<std::string> specimen;  ///< none: of all
  std::string name;                     ///< "k1", "k1 of flap"
};

class Model {
 public:
  /// `incompressible`: the volume is kept whatever the bulk modulus of the law; none: as the bulk modulus says.
  Model(const LawTemplate& law, const std::vector<Protocol>& protocols, std::optional<bool> incompressible,
        wall::VolumetricEnergy energy);

  const std::vector<Protocol>& protocols() const { return *protocols_; }
  const LawTemplate& law() const { return law_; }
  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  const std::vector<std::string>& specimens() const { return specimens_; }
  const Parameter& parameter(std::size_t unknown) const { return law_.parameters()[unknowns_[unknown].parameter]; }
  /// Starting values, scaled.
  std::vector<double> start() const;
  /// In SI units.
  std::vector<double> values(std::span<const double> scaled) const;
  /// Of the parameters for one specimen, in SI units.
  std::vector<double> values_of(const std::string& specimen, std::span<const double> scaled) const;
  wall::LawParameters parameters_of(const std::string& specimen, std::span<const double> scaled) const;

  /// Dispersed fibres are summed over a product rule that keeps `tolerance` of the stress at these values, the same for
  /// all values, since a rule that changed on the way would make steps in the residuals. Without effect for other laws.
  void choose_directions(std::span<const double> scaled, double tolerance);

  /// Predicted stresses of all protocols [Pa]. Throws InputError, SolverError.
  std::vector<std::vector<double>> predicted(std::span<const double> scaled) const;
  wall::Volumetric volumetric(const wall::LawParameters& parameters) const;
  /// With the directions of this fit.
  wall::Law make_law(const wall::LawParameters& parameters) const;

  /// Weighted residuals [kPa] of all protocols in turn, law minus `targets` (as predicted() orders them); false where
  /// the law has no stress.
  bool residuals(std::span<const double> scaled, const std::vector<std::vector<double>>& targets,
                 std::vector<double>& out) const;
  /// The same as a function, which refers to this model.
  Residuals against(std::vector<std::vector<double>> targets) const;
  /// What was measured, in the order of predicted().
  std::vector<std::vector<double>> measured() const;
  std::size_t count() const;  ///< of residuals

 private:
  LawTemplate law_;
  const std::vector<Protocol>* protocols_;
  std::optional<bool> incompressible_;
  wall::VolumetricEnergy energy_;
  std::vector<std::string> specimens_;
  std::vector<Unknown> unknowns_;
  std::optional<wall::RuleSize> directions_;
};

}  // namespace tunica::fitting
