#include "power_of_two.hpp"
#include "tunica/base/pack.hpp"

namespace tunica::test {
void exp2_avx512(const double (&x)[8], double (&y)[8]) { exp2_of_nonnegative(Pack<8>::load(x)).store(y); }
}  // namespace tunica::test
