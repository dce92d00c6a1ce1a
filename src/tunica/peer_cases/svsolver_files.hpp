// A simulation of SimVascular's svSolver: the commands of its presolver (.svpre), solver.inp and rcrt.dat, as the same
// tree of keys that an input file of svFSI becomes.
#pragma once

#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

/// Keys of what the files say as they stand there, besides those in the names of solver.xml: no other format can have
/// keys with a blank.
inline constexpr const char *svpre_commands = "presolver commands", *svsolver_settings = "solver settings",
                            *bct_period = "bct period", *bct_modes = "bct modes";

/// `presolver`: the .svpre; solver.inp and rcrt.dat lie beside it. Faces are called after the files that commands name.
/// Throws InputError with file and line where one of them does not read.
PeerFile read_svsolver(const std::filesystem::path& presolver);

}  // namespace tunica::peer_cases
