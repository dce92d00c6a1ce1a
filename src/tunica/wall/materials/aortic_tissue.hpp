// Parameters of dispersed fibres for the parts of a dissected aorta, for cases without tests on the patient's tissue.
//
// Dispersion: a = 2.54, b = 19.44, human aortic media (Holzapfel et al. 2015, doi:10.1098/rsif.2015.0188); out of the
// plane it is small in every layer (Schriefl et al. 2012, doi:10.1098/rsif.2011.0727).
// Mean angles: nearer to the circumference in the media, nearer to the axis in the adventitia (Schriefl et al. 2012).
// Stiffness: no values for this law by region of the human dissection are published. Young's moduli at rest lie within
// the 200 to 800 kPa of the healthy aorta, to which the wall of Baeumler et al. 2020 was set as well. What is left of
// the wall at the false lumen, outer media and adventitia, is the stiffest; the flap, intima and inner media, the
// softest.
// Chronic dissection, adventitia: measured in planar biaxial tests (second Piola-Kirchhoff stress of 81/80 kPa at
// Green-Lagrange strains 0.172/0.203, 77/45 at 0.214/0.066, 43/77 at 0.065/0.248). Shear modulus, k2, angle and a are
// those published for them; k1 is a third of the published 34 kPa, which is what these states ask for with the density
// as it is normalised here.
#pragma once

#include "tunica/wall/materials/dfd.hpp"

namespace tunica::wall {

enum class AorticTissue { true_lumen_wall, false_lumen_wall, flap, chronic_adventitia };

/// Matrix of Poisson's ratio 0.49 and two families on either side of the circumference.
DfdParameters aortic_tissue(AorticTissue tissue);

}  // namespace tunica::wall
