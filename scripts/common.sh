# Shared by the scripts of this folder; meant to be sourced, from any working directory.
set -euo pipefail

TUNICA_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '== %s\n' "$*"; }

die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Compile jobs: one per core, but no more than the memory holds. The vectorised kernels need about 1.5 GB each.
build_jobs() {
  local cores memory_kb by_memory
  cores=$(nproc)
  memory_kb=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
  by_memory=$((memory_kb / 1500000))
  ((by_memory >= 1)) || by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}

# Open MPI as it has to be in containers and on small machines: root is allowed when we are root, several runs side by
# side are not all bound to the first cores, and ranks on one host may exchange messages without ptrace rights.
mpi_environment() {
  if [[ $(id -u) -eq 0 ]]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
  export OMPI_MCA_hwloc_base_binding_policy=none
  export OMPI_MCA_btl_vader_single_copy_mechanism=none
  export OMPI_MCA_rmaps_base_oversubscribe=1
  export OMP_NUM_THREADS=1
}

# build_dir PRESET: where CMakePresets.json puts that build.
build_dir() { echo "$TUNICA_ROOT/build/$1"; }

# configure_and_build PRESET [TARGET]: everything, or one target.
configure_and_build() {
  local preset=$1 target=${2:-all}
  say "configure: preset $preset"
  (cd "$TUNICA_ROOT" && cmake --preset "$preset")
  say "build: preset $preset, $(build_jobs) jobs"
  cmake --build "$(build_dir "$preset")" --target "$target" --parallel "$(build_jobs)"
}
