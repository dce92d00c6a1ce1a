#include "tunica/wall/material_batch.inl.hpp"

namespace tunica::wall {
template MaterialBatch material_batch<2>();
}
