// The list of wall laws. A new law is a file in materials/, an entry in Law (if it needs new kernels) and in
// LawParameters, and example parameters in the laws' test.
//
// The parameters of a law are what the case file fills: schema(), law(), which prepares the law for the kernels, and
// bulk_modulus(). Several may share one law.
#pragma once

#include <concepts>
#include <string>
#include <variant>
#include <vector>

#include "tunica/wall/materials/dfd.hpp"
#include "tunica/wall/materials/fung.hpp"
#include "tunica/wall/materials/hgo.hpp"
#include "tunica/wall/materials/holzapfel_ogden.hpp"
#include "tunica/wall/materials/mooney_rivlin.hpp"
#include "tunica/wall/materials/neo_hooke.hpp"
#include "tunica/wall/materials/st_venant_kirchhoff.hpp"

namespace tunica::wall {

using Law =
    std::variant<NeoHooke, MooneyRivlin, StructureTensorLaw, Fung, DiscreteFibreLaw, StVenantKirchhoff, HolzapfelOgden>;

/// Parameters of one of the laws, as the case file gives them.
using LawParameters =
    std::variant<NeoHookeParameters, MooneyRivlinParameters, HgoParameters, GohParameters, FungParameters,
                 DfdParameters, StVenantKirchhoffParameters, HolzapfelOgdenParameters>;

/// Prepares a law; the parameters must have passed the checks of their schema. Throws InputError when a rule of fibre
/// directions cannot keep its tolerance.
Law make_law(const LawParameters& parameters);

/// K [Pa], infinite when incompressible.
double bulk_modulus(const LawParameters& parameters);

/// Of the law at rest, without its fibres [Pa].
double matrix_shear_modulus(const LawParameters& parameters);

double shear_modulus_at_rest(const Law& law);

bool has_unsplit_part(const Law& law);

/// What a log should say of a law once it is prepared: the rule of fibre directions and its error. One line each.
std::vector<std::string> notes(const Law& law);

/// Does the law distinguish directions, so that it needs a fibre frame?
bool is_anisotropic(const LawParameters& parameters);

/// Mean direction of each family of fibres in the fibre frame, unit vectors; none for laws without families.
std::vector<Vec3<double>> mean_fibre_directions(const LawParameters& parameters);

config::Schema<LawParameters> law_schema();

}  // namespace tunica::wall
