#include "tunica/coupling/element_loops.hpp"

namespace tunica::coupling {

extern template ElementLoops make_element_loops<2>();
extern template ElementLoops make_element_loops<4>();
extern template ElementLoops make_element_loops<8>();

const ElementLoops& element_loops(assembly::Isa isa) {
  static const ElementLoops sse2 = make_element_loops<2>();
  static const ElementLoops avx2 = make_element_loops<4>();
  static const ElementLoops avx512 = make_element_loops<8>();
  return isa == assembly::Isa::avx512 ? avx512 : isa == assembly::Isa::avx2 ? avx2 : sse2;
}

}  // namespace tunica::coupling
