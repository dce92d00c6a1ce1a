#include "mpi_main.hpp"

int main(int argc, char** argv) { return tunica::test::mpi_main(argc, argv); }
