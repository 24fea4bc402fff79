# SPDX-License-Identifier: BSD-3-Clause
# Sourced by surveys/run, tests/run and .ci/run: from a bare Debian 12 to built tools.
# The caller sets `root`, the checkout. POSIX sh; the environment may set
#   SLIPWAVE_BUILD       the build directory           (build/release)
#   SLIPWAVE_CMAKE_ARGS  more arguments for cmake's first configuration, split at blanks

build=${SLIPWAVE_BUILD:-$root/build/release}

say() { printf 'slipwave: %s\n' "$*" >&2; }
fail() { say "$*"; exit 1; }

# A program that stands on PATH counts, wherever it came from; "-" means that only the package itself does.
build_needs='cmake=cmake ninja-build=ninja make=make g++=g++ pkg-config=pkg-config
  libboost-program-options-dev=- libtbb-dev=- libfftw3-dev=- libnetcdf-dev=- libudunits2-dev=- libpango1.0-dev=-
  fonts-dejavu-core=- libgtest-dev=-'

# missing_of PACKAGE=PROGRAM ... : prints the packages that are not there.
missing_of() {
  wanted=
  for need in "$@"; do
    program=${need#*=}
    if [ "$program" = - ] || ! command -v "$program" >/dev/null 2>&1; then wanted="$wanted ${need%%=*}"; fi
  done
  [ -n "$wanted" ] || return 0
  # shellcheck disable=SC2086
  there=" $(dpkg-query -W -f='${Package}=${db:Status-Status} ' $wanted 2>/dev/null || :)"
  for package in $wanted; do
    case $there in
      *" $package=installed "*) ;;
      *) printf '%s ' "$package" ;;
    esac
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# apt_get [ARGUMENT...]: apt-get that asks nothing, waits for another apt to finish and speaks only when it fails.
apt_get() {
  log=$(mktemp)
  if as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" </dev/null >"$log" 2>&1; then
    rm -f "$log"
    return 0
  fi
  cat "$log" >&2
  rm -f "$log"
  return 1
}

# install_needs PACKAGE=PROGRAM ... : installs what is missing, saying what; leaves apt alone when nothing is.
install_needs() {
  if ! command -v dpkg-query >/dev/null 2>&1; then
    say "this is no Debian: install by hand what the build below asks for"
    return 0
  fi
  missing=$(missing_of "$@")
  missing=${missing% }
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null 2>&1; then
    fail "these packages are missing and there is no sudo; as root: apt-get install $missing"
  fi
  how=
  [ "$(id -u)" = 0 ] || how=' (by sudo)'
  say "installing$how: $missing"
  # Without package lists, or with lists that do not know a package, ask for new ones first.
  # shellcheck disable=SC2086
  apt-get -qq -s install $missing >/dev/null 2>&1 || apt_get update || fail "apt-get update failed"
  # shellcheck disable=SC2086
  apt_get install -y --no-install-recommends $missing && return 0
  say "that failed; once more with new package lists"
  apt_get update || fail "apt-get update failed"
  # shellcheck disable=SC2086
  apt_get install -y --no-install-recommends $missing || fail "apt-get could not install $missing"
}

jobs_default() { nproc 2>/dev/null || echo 2; }

# configure_build: an optimised build in $build. A build made for a checkout that has moved is begun afresh.
configure_build() {
  if [ -f "$build/CMakeCache.txt" ]; then
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
    if [ "$home" != "$root" ]; then
      say "$build was made for $home: configuring it afresh"
      rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"
    fi
  fi
  # Later changes of the CMake files are seen by the build itself; packages installed since then (MPI, which tests want)
  # are not. First builds are what counts here: whoever changes sources often configures a build where each is compiled by
  # itself.
  if [ ! -f "$build/CMakeCache.txt" ] || [ ! -f "$build/build.ninja" ] || [ ! -f "$build/configured" ] ||
    [ -n "$(find /var/lib/dpkg/status -newer "$build/configured" 2>/dev/null)" ]; then
    # Inner loops for other processors than this one would take a third of the time of compiling the tools.
    # shellcheck disable=SC2086
    cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSLIPWAVE_UNITY=ON -DSLIPWAVE_KERNELS=native \
      ${SLIPWAVE_CMAKE_ARGS-} >&2 ||
      fail "cmake could not configure the build in $build"
    : >"$build/configured"
  fi
}

# build_targets JOBS TARGET...
build_targets() {
  jobs=$1
  shift
  cmake --build "$build" -j "$jobs" --target "$@" >&2 || fail "the build in $build failed"
}

# build_tools: the executables of tools/, nothing else.
build_tools() {
  # shellcheck disable=SC2086
  install_needs $build_needs
  configure_build
  build_targets "$(jobs_default)" tools/all
}
