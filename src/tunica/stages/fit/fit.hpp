// `tunica fit`: parameters of wall laws from measured points, and what these determine.
#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/case/fit_case.hpp"
#include "tunica/fitting/uncertainty.hpp"
#include "tunica/fitting/vessel.hpp"

namespace tunica::stages {

/// The law of a specimen at the stress that its wall bears in the body.
struct InVivo {
  std::string specimen;
  std::optional<fitting::VesselPoint> point;             ///< none: the law does not come to that stress
  std::vector<fitting::Interval> moduli;                 ///< 95 % by bootstrap [Pa], as those of the point
  std::optional<std::array<double, 2>> not_convex_at{};  ///< stretches
};

/// A law after its fit.
struct FittedModel {
  std::string name;
  fitting::Model model;
  fitting::Fit fit;
  fitting::Uncertainty uncertainty;
  std::vector<std::optional<fitting::Deviation>> held_out;  ///< by protocol
  std::vector<std::string> remarks;                         ///< on bounds, on what is not identified
  std::vector<InVivo> in_vivo{};  ///< of each specimen where these have values of their own, otherwise one
  fitting::Criteria criteria{};
};

/// Fits all laws, the best by BIC first, and writes fit.html, fit.json and <law>.yaml, or <law>_<specimen>.yaml where
/// specimens have values of their own, into the folder of results. Throws InputError, SolverError.
void run_fit(const std::filesystem::path& file, const std::optional<std::filesystem::path>& directory,
             std::FILE* screen);

/// The page of the report.
std::string fit_page(const case_file::FitCase& c, const std::vector<fitting::Protocol>& protocols,
                     const std::vector<FittedModel>& ranked, const std::vector<std::string>& remarks_on_data);

}  // namespace tunica::stages
