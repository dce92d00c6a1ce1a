#include "tunica/artifacts/libraries.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <petscversion.h>
#include <vtkVersion.h>

#include "tunica/assembly/isa.hpp"

namespace tunica::artifacts {

namespace {

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string version(text);
  return version.substr(0, version.find(','));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> libraries() {
  return {{"PETSc", fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
          {"MPI", mpi_version()},
          {"VTK", vtkVersion::GetVTKVersion()},
          {"compiler", __VERSION__}};
}

std::string instruction_set() { return assembly::name(assembly::choose_isa()); }

}  // namespace tunica::artifacts
