# SPDX-License-Identifier: GPL-3.0-or-later
# What the scripts share: installing packages, quiet steps with their time, building a preset. Sourced, never run.

set -euo pipefail
export LC_ALL=C.UTF-8  # a bare Debian has this locale and no other
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${0##*/}
logs=build/logs
jobs=${MORTISE_JOBS:-$(nproc)}

fail() {
  printf '%s: error: %s\n' "$program" "$*" >&2
  exit 1
}

# packages SECTION...: names listed in scripts/packages.txt under these sections.
packages() {
  local section name rest
  while read -r name rest; do
    case $name in
      '' | '#'*) ;;
      '['*) section=${name//[][]/} ;;
      *) case " $* " in *" $section "*) echo "$name" ;; esac ;;
    esac
  done <scripts/packages.txt
}

# missing SECTION...: those of them that neither are installed nor come with a package that is.
missing() {
  local name provided
  # NodeSource's nodejs, for one, provides npm and conflicts with the package of that name.
  provided=$(dpkg-query -W -f '${db:Status-Status} ${Provides}\n' 2>/dev/null |
    sed -n 's/^installed //p' | tr ',' '\n' | sed 's/^ *//; s/[ (].*//')
  for name in $(packages "$@"); do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] ||
      grep -qxF -- "$name" <<<"$provided" || echo "$name"
  done
}

# install_missing SECTION...: installs what is not there yet, as root or through sudo.
install_missing() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "$program: not a Debian system; going on with the libraries that are here (scripts/packages.txt lists them)" >&2
    return
  fi
  local wanted as_root=()
  wanted=$(missing "$@" | tr '\n' ' ')
  [ -n "$wanted" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "packages are missing and there is no sudo; as root, run: apt-get update && apt-get install --no-install-recommends $wanted"
    as_root=(sudo)
  fi
  step "install packages ($(wc -w <<<"$wanted"))" apt_install "${as_root[@]}" -- $wanted
  wanted=$(missing "$@" | tr '\n' ' ')
  [ -z "$wanted" ] || fail "apt-get did not install: $wanted"
}

# apt_install [sudo] -- PACKAGE...
apt_install() {
  local as_root=()
  while [ "$1" != -- ]; do as_root+=("$1") && shift; done
  shift
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600)
  "${apt[@]}" update || echo "apt-get update failed; trying with the package lists at hand"
  "${apt[@]}" install --no-install-recommends "$@"
}

# step "NAME" COMMAND...: runs it with its output in build/logs, prints name and seconds; on failure the output's end.
step() {
  local name=$1 start=$SECONDS status=0
  shift
  mkdir -p "$logs"
  local log="$logs/$program-${name//[^a-zA-Z0-9]/_}.log"
  printf '%-44s' "$name" >&2
  # A subshell of its own: under `||` bash would ignore set -e inside a function.
  set +e
  (
    set -e
    "$@"
  ) </dev/null >"$log" 2>&1
  status=$?
  set -e
  if [ "$status" -ne 0 ]; then
    printf 'FAILED after %d s\n' $((SECONDS - start)) >&2
    tail -n "${MORTISE_LOG_LINES:-60}" "$log" >&2
    fail "$name failed; the whole log is $log"
  fi
  printf '%4d s\n' $((SECONDS - start)) >&2
}

# build PRESET [CMAKE BUILD OPTION...]: configures and builds; with ccache if it is there. Sources are joined unless the
# folder was configured otherwise, as by a developer, who compiles single files again and again.
build() {
  local preset=$1 options=()
  shift
  if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  # A checkout that was moved: CMake refuses the old cache.
  local cache=build/$preset/CMakeCache.txt
  if [ ! -f "$cache" ]; then
    options+=(-DMORTISE_JOINED=ON)
  elif ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$(pwd -P)" "$cache"; then
    options+=(--fresh -DMORTISE_JOINED=ON)
  fi
  cmake --preset "$preset" "${options[@]}"
  cmake --build --preset "$preset" -j "$jobs" "$@"
}
