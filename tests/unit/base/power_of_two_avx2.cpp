#include "power_of_two.hpp"
#include "tunica/base/pack.hpp"

namespace tunica::test {
void exp2_avx2(const double (&x)[4], double (&y)[4]) { exp2_of_nonnegative(Pack<4>::load(x)).store(y); }
}  // namespace tunica::test
