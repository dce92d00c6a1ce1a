// Bodies of block_kernels.hpp; included only by the translation units of one instruction set each.
#pragma once

#include "tunica/assembly/block_kernels.hpp"
#include "tunica/base/pack.hpp"

namespace tunica::assembly {

namespace {  // internal: never shared between instruction sets

typedef float Float4 __attribute__((vector_size(16)));
typedef double Double4 __attribute__((vector_size(32)));
typedef std::uint16_t Half4 __attribute__((vector_size(8)));
typedef std::uint32_t Bits4 __attribute__((vector_size(16)));

TUNICA_INLINE Float4 load4(const float* p) {
  Float4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
TUNICA_INLINE void store4(float* p, Float4 v) { __builtin_memcpy(p, &v, sizeof v); }

// Four numbers that are the upper halves of floats.
TUNICA_INLINE Float4 load_rounded(const unsigned char* p) {
  Half4 half;
  __builtin_memcpy(&half, p, sizeof half);
  return (Float4)(__builtin_convertvector(half, Bits4) << 16);
}
TUNICA_INLINE void store_rounded(unsigned char* p, Float4 v) {
  const Half4 half = __builtin_convertvector(((Bits4)v + 0x8000U) >> 16, Half4);
  __builtin_memcpy(p, &half, sizeof half);
}

template <int W>
void multiply(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns, const float* blocks,
              const double* x, double* y) {
  for (std::int32_t row = 0; row < rows; ++row) {
    Double4 s0{}, s1{}, s2{}, s3{};
    for (std::int32_t b = row_begin[row]; b < row_begin[row + 1]; ++b) {
      const float* a = blocks + 16 * static_cast<std::ptrdiff_t>(b);
      const double* v = x + 4 * static_cast<std::ptrdiff_t>(columns[b]);
      s0 += __builtin_convertvector(load4(a), Double4) * v[0];
      s1 += __builtin_convertvector(load4(a + 4), Double4) * v[1];
      s2 += __builtin_convertvector(load4(a + 8), Double4) * v[2];
      s3 += __builtin_convertvector(load4(a + 12), Double4) * v[3];
    }
    const Double4 s = (s0 + s1) + (s2 + s3);
    __builtin_memcpy(y + 4 * static_cast<std::ptrdiff_t>(row), &s, sizeof s);
  }
}

template <int W>
void multiply3(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns, const float* blocks,
               const double* x, double* y) {
  for (std::int32_t row = 0; row < rows; ++row) {
    Double4 s0{}, s1{}, s2{};
    for (std::int32_t b = row_begin[row]; b < row_begin[row + 1]; ++b) {
      const float* a = blocks + 12 * static_cast<std::ptrdiff_t>(b);
      const double* v = x + 4 * static_cast<std::ptrdiff_t>(columns[b]);
      s0 += __builtin_convertvector(load4(a), Double4) * v[0];
      s1 += __builtin_convertvector(load4(a + 4), Double4) * v[1];
      s2 += __builtin_convertvector(load4(a + 8), Double4) * v[2];
    }
    const Double4 s = (s0 + s1) + s2;
    __builtin_memcpy(y + 4 * static_cast<std::ptrdiff_t>(row), &s, sizeof s);
  }
}

// c -= a b for 3 x 3 blocks in padded columns.
TUNICA_INLINE void subtract_product(float* c, const float* a, const float* b) {
  const Float4 a0 = load4(a), a1 = load4(a + 4), a2 = load4(a + 8);
  for (int j = 0; j < 3; ++j)
    store4(c + 4 * j, load4(c + 4 * j) - (a0 * b[4 * j] + a1 * b[4 * j + 1] + a2 * b[4 * j + 2]));
}

TUNICA_INLINE Float4 product(const float* a, const float* x) {
  return load4(a) * x[0] + load4(a + 4) * x[1] + load4(a + 8) * x[2];
}

// Inverse of a 3 x 3 block; computed in double. Returns false when it is singular.
inline bool invert(const float* a, float* inverse) {
  const double m[9] = {a[0], a[4], a[8], a[1], a[5], a[9], a[2], a[6], a[10]};  // row-major
  double c[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c[3 * i + j] = m[3 * j1 + i1] * m[3 * j2 + i2] - m[3 * j1 + i2] * m[3 * j2 + i1];
    }
  const double det = m[0] * c[0] + m[1] * c[3] + m[2] * c[6];
  if (!(det > 0.0) && !(det < 0.0)) return false;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) inverse[4 * j + i] = static_cast<float>(c[3 * i + j] / det);
    inverse[4 * j + 3] = 0;
  }
  return true;
}

// s - sum over the row's blocks of block x.
TUNICA_INLINE Float4 eliminate(const IluFactors::Triangle& t, std::int32_t row, Float4 s, const float* x) {
  const auto* blocks = reinterpret_cast<const unsigned char*>(t.blocks);
  for (std::int32_t b = t.row_begin[row]; b < t.row_begin[row + 1]; ++b) {
    const unsigned char* a = blocks + 24 * static_cast<std::ptrdiff_t>(b);
    const float* v = x + 4 * static_cast<std::ptrdiff_t>(t.columns[b]);
    s -= load_rounded(a) * v[0] + load_rounded(a + 8) * v[1] + load_rounded(a + 16) * v[2];
  }
  return s;
}

// Ascending, since a rounded block ends before the float that comes next.
template <int W>
void ilu_round(const IluFactors& f) {
  for (const auto* t : {&f.lower, &f.upper}) {
    auto* rounded = reinterpret_cast<unsigned char*>(t->blocks);
    for (std::ptrdiff_t k = 0; k < 3 * static_cast<std::ptrdiff_t>(t->row_begin[f.rows]); ++k)
      store_rounded(rounded + 8 * k, load4(t->blocks + 4 * k));
  }
}

template <int W>
void ilu_solve(const IluFactors& f, float* x) {
  for (std::int32_t row = 0; row < f.rows; ++row) {
    float* own = x + 4 * static_cast<std::ptrdiff_t>(row);
    store4(own, eliminate(f.lower, row, load4(own), x));
  }
  for (std::int32_t row = f.rows - 1; row >= 0; --row) {
    float* own = x + 4 * static_cast<std::ptrdiff_t>(row);
    float s[4];
    store4(s, eliminate(f.upper, row, load4(own), x));
    store4(own, product(f.inverse_diagonal + 12 * static_cast<std::ptrdiff_t>(row), s));
  }
}

// Marks (or unmarks) where the blocks of a row stand.
inline void mark(const IluFactors::Triangle& t, std::int32_t row, std::int32_t* position, bool set) {
  for (std::int32_t b = t.row_begin[row]; b < t.row_begin[row + 1]; ++b) position[t.columns[b]] = set ? b : -1;
}

// Block ILU(0), row by row (Saad 2003, algorithm 10.4). On entry `inverse_diagonal` holds the diagonal blocks.
template <int W>
std::int32_t ilu_factorise(const IluFactors& f, std::int32_t* position) {
  std::int32_t singular = -1;
  for (std::int32_t i = 0; i < f.rows && singular < 0; ++i) {
    mark(f.lower, i, position, true);
    mark(f.upper, i, position, true);
    float* diagonal = f.inverse_diagonal + 12 * static_cast<std::ptrdiff_t>(i);
    for (std::int32_t b = f.lower.row_begin[i]; b < f.lower.row_begin[i + 1]; ++b) {
      const std::int32_t k = f.lower.columns[b];
      float* lower = f.lower.blocks + 12 * static_cast<std::ptrdiff_t>(b);
      float scaled[12] = {};
      const float* inverse = f.inverse_diagonal + 12 * static_cast<std::ptrdiff_t>(k);
      for (int j = 0; j < 3; ++j) store4(scaled + 4 * j, product(lower, inverse + 4 * j));
      for (int j = 0; j < 12; ++j) lower[j] = scaled[j];
      for (std::int32_t u = f.upper.row_begin[k]; u < f.upper.row_begin[k + 1]; ++u) {
        const std::int32_t j = f.upper.columns[u];
        const float* upper = f.upper.blocks + 12 * static_cast<std::ptrdiff_t>(u);
        if (j == i)
          subtract_product(diagonal, lower, upper);
        else if (position[j] >= 0)
          subtract_product((j < i ? f.lower : f.upper).blocks + 12 * static_cast<std::ptrdiff_t>(position[j]), lower,
                           upper);
      }
    }
    float inverse[12];
    if (invert(diagonal, inverse))
      for (int j = 0; j < 12; ++j) diagonal[j] = inverse[j];
    else
      singular = i;
    mark(f.lower, i, position, false);
    mark(f.upper, i, position, false);
  }
  return singular;
}

template <int W>
void multiply_rows(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns, const float* blocks,
                   const double* x, double* y) {
  for (std::int32_t row = 0; row < rows; ++row) {
    Double4 s{};
    for (std::int32_t b = row_begin[row]; b < row_begin[row + 1]; ++b) {
      Double4 v;
      __builtin_memcpy(&v, x + 4 * static_cast<std::ptrdiff_t>(columns[b]), sizeof v);
      s += __builtin_convertvector(load4(blocks + 4 * static_cast<std::ptrdiff_t>(b)), Double4) * v;
    }
    y[row] = s[0] + s[1] + s[2];
  }
}

template <int W>
void multiply_columns(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns,
                      const float* blocks, const double* x, double* y) {
  for (std::int32_t row = 0; row < rows; ++row) {
    Double4 s{};
    for (std::int32_t b = row_begin[row]; b < row_begin[row + 1]; ++b)
      s += __builtin_convertvector(load4(blocks + 4 * static_cast<std::ptrdiff_t>(b)), Double4) * x[columns[b]];
    __builtin_memcpy(y + 4 * static_cast<std::ptrdiff_t>(row), &s, sizeof s);
  }
}

}  // namespace

template <int W>
BlockKernels make_block_kernels() {
  return {&multiply<W>,  &multiply3<W>, &multiply_rows<W>, &multiply_columns<W>,
          &ilu_round<W>, &ilu_solve<W>, &ilu_factorise<W>};
}

}  // namespace tunica::assembly
