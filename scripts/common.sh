# shellcheck shell=bash
# Sourced by the scripts beside it: where the project is, and how one preset of it is built.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# build_preset PRESET TARGET...: configures build/PRESET the first time, then builds the targets that are out of date.
build_preset() {
  local preset=$1 build=$root/build/$1
  shift
  if [[ ! -f $build/build.ninja ]]; then
    local launcher=()
    if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
    (cd "$root" && cmake --preset "$preset" "${launcher[@]}")
  fi
  cmake --build "$build" --target "$@"
}
