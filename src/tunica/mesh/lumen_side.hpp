// The node field by which a mesh tells the lumens of a dissection apart where no wall does.
#pragma once

namespace tunica::mesh {

/// > 0 in the true lumen.
inline constexpr const char* lumen_side = "lumen_side";

}  // namespace tunica::mesh
