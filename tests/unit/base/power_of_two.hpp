// 2^x as the compiled instruction set computes it, for comparison on the machines that have it.
#pragma once

namespace tunica::test {

void exp2_avx2(const double (&x)[4], double (&y)[4]);
void exp2_avx512(const double (&x)[8], double (&y)[8]);

}  // namespace tunica::test
