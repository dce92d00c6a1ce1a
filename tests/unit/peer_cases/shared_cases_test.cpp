// The peers' own test cases: those that tunica can pose are translated, the others say what is missing.
#include <gtest/gtest.h>

#include <filesystem>

#include "folders.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/peer_cases/translate.hpp"

namespace tunica::peer_cases {

namespace {

namespace fs = std::filesystem;

struct Expected {
  const char *file, *units;
  const char* missing;  ///< a part of the error; empty: it is translated
};

const Expected all[] = {
    {"cmm/pipe_3d/1-rigid-solution/solver.xml", "cgs", ""},
    {"fluid/carreau_yasuda/solver.xml", "cgs", ""},
    {"fluid/casson/solver.xml", "cgs", ""},
    {"fluid/newtonian/solver.xml", "cgs", ""},
    {"fluid/pipe_RCR_3d/solver.xml", "cgs", ""},
    {"fluid/pipe_RCR_3d_fourier_coeff/solver.xml", "cgs", ""},
    {"fluid/pipe_RCR_3d_trilinos_bj/solver.xml", "cgs", ""},
    {"fluid/pipe_RCR_sv0D/solver.xml", "cgs", ""},
    {"fluid/pipe_RCR_weak_dir_3d/solver.xml", "cgs", "solver.xml:112 Weakly_applied"},
    {"fluid/quadratic_tet10/solver.xml", "cgs", ""},
    {"fsi/pipe_3d/solver.xml", "cgs", ""},
    {"fsi/pipe_3d_petsc/solver.xml", "cgs", ""},
    {"fsi_ustruct/pipe_3d/solver.xml", "cgs", ""},
    {"struct/LV_HolzapfelOgden_passive/solver.xml", "cgs", ""},
    {"struct/LV_NeoHookean_passive/solver.xml", "cgs", ""},
    {"struct/block_compression/solver.xml", "si", ""},
    {"struct/robin/solver.xml", "cgs", ""},
    {"struct/spatially_variable_robin/solver.xml", "cgs", ""},
    {"struct/tensile_adventitia_Newtonian_viscosity/solver.xml", "cgs", ""},
    {"struct/uniaxial_block_stretch/solver.xml", "si", ""},
    {"ustruct/block_compression/P1P1_VMS/solver.xml", "mmgs", ""},
    {"ustruct/tensile_adventitia_HGO/solver.xml", "mmgs", ""},
    {"svFSI/04-fluid/01-pipe3D_RCR/svFSI.inp", "cgs", ""},
    {"svFSI/04-fluid/05-nonNewtonian/svFSI_CYa.inp", "cgs", ""},
    {"svFSI/04-fluid/05-nonNewtonian/svFSI_Cassons_a.inp", "cgs", ""},
    {"svFSI/05-struct/01-block-compression/P1_svFSI.inp", "si", ""},
    {"svFSI/06-ustruct/02-tensile-adventitia_HGO/svFSI.inp", "mmgs", ""},
    {"svFSI/07-fsi/ale/01-channel-leaflets_2D/svFSI.inp", "cgs", "two dimensions"},
    {"svFSI/07-fsi/ale/03-pipe_3D/svFSI.inp", "cgs", ""},
    {"svFSI/svFSI_master.inp", "cgs", "NURBS"},
};

class SharedCases : public testing::TestWithParam<Expected> {};

TEST_P(SharedCases, AreTranslatedOrSayWhatIsMissing) {
  const fs::path folder = fs::path(TUNICA_SHARED_DATA) / "svmp_cases";
  if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
  const Expected& expected = GetParam();
  const auto message = test::message_of<InputError>([&] {
    const auto translation = translate(read_peer_file(folder / expected.file), unit_system(expected.units), folder);
    EXPECT_NE(translation.yaml.find("\nboundary:\n"), std::string::npos) << translation.yaml;
  });
  if (*expected.missing == '\0')
    EXPECT_EQ(message, "");
  else
    EXPECT_NE(message.find(expected.missing), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(All, SharedCases, testing::ValuesIn(all));

}  // namespace

}  // namespace tunica::peer_cases
