// Planted for the test of the include check; never compiled.
#pragma once

#include <vtkPoints.h>
#include <CGAL/Mesh_3/config.h>
