// Instruction sets for which the hot loops are compiled, chosen when the program starts.
#pragma once

namespace tunica::assembly {

/// The value is the number of doubles in a register, so the width of the packs (base/pack.hpp).
enum class Isa : int { sse2 = 2, avx2 = 4, avx512 = 8 };

/// The widest set that this processor and this build have (sanitized builds, TUNICA_BASELINE_ISA, have sse2 alone).
/// TUNICA_ISA=sse2|avx2|avx512 in the environment chooses a narrower one (for comparisons); asking for one that the
/// processor lacks throws InputError.
Isa choose_isa();

const char* name(Isa isa);

}  // namespace tunica::assembly
