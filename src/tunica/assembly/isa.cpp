#include "tunica/assembly/isa.hpp"

#include <cstdlib>
#include <string>

#include "tunica/base/error.hpp"

namespace tunica::assembly {

namespace {
Isa widest() {
#ifdef TUNICA_BASELINE_ISA
  return Isa::sse2;
#else
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return Isa::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Isa::avx2;
  return Isa::sse2;
#endif
}
}  // namespace

Isa choose_isa() {
  const Isa best = widest();
  const char* wish = std::getenv("TUNICA_ISA");
  if (wish == nullptr) return best;
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512})
    if (std::string(wish) == name(isa) && isa <= best) return isa;
  throw InputError(
      "environment variable TUNICA_ISA",
      std::string("'") + wish + "' is not an instruction set of this processor, which has up to " + name(best),
      "unset it, or choose one of sse2, avx2, avx512 up to that");
}

const char* name(Isa isa) { return isa == Isa::sse2 ? "sse2" : isa == Isa::avx2 ? "avx2" : "avx512"; }

}  // namespace tunica::assembly
