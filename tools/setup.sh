# shellcheck shell=bash
# Shared by tools/run, tools/test and tools/check: what must be installed, the build, and what MPI needs.
# Exit statuses are the program's: 1 wrong input, 3 the machine failed.

root=$(CDPATH='' cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd -P)
requirements=$root/tools/requirements.txt
venv=$root/build/venv
studio_requirements=$root/tools/requirements_studio.txt
studio_venv=$root/build/studio_venv

# Git looks for no repository above this folder: one around an unpacked archive is somebody else's, with settings of theirs.
GIT_CEILING_DIRECTORIES=$(dirname -- "$root")
export GIT_CEILING_DIRECTORIES

run_packages=(gfortran gcc libc6-dev cmake ninja-build pkg-config git libopenmpi-dev openmpi-bin
  petsc-dev slepc-dev libhdf5-openmpi-dev libmetis-dev libmumps-dev libsuitesparse-dev libopenblas0-serial python3)
# shellcheck disable=SC2034 # used by those who source this
report_packages=(python3-numpy python3-h5py python3-matplotlib python3-jinja2)
# shellcheck disable=SC2034
tool_packages=("${report_packages[@]}" python3-xarray)
studio_packages=("${tool_packages[@]}" python3-venv util-linux ca-certificates)
# shellcheck disable=SC2034
test_packages=("${run_packages[@]}" python3-venv python3-numpy python3-h5py python3-matplotlib python3-xarray
  python3-scipy python3-jinja2 findent hunspell hunspell-en-gb
  ca-certificates)
# shellcheck disable=SC2034
package_packages=(dpkg-dev file patchelf python3-pip python3-setuptools python3-wheel)
# shellcheck disable=SC2034
long_packages=("${package_packages[@]}" libjs-mathjax)
libraries='gfortran, a C compiler, CMake 3.21, Ninja, pkg-config, Open MPI or another MPI, PETSc 3.18 with
  MUMPS, SLEPc 3.18, HDF5 for that MPI with its Fortran interface, METIS, BLAS and LAPACK, Python 3'

say() {
  printf '%s\n' "$*" >&2
}

stop() {
  say "$*"
  exit 3
}

# Only one call at a time installs and builds in this checkout.
lock_build() {
  mkdir -p -- "$root/build" || stop "cannot write in $root"
  if command -v flock >/dev/null; then
    exec 9>"$root/build/lock"
    flock -n 9 || { say 'another call is building here: waiting for it'; flock 9; }
  fi
}

unlock_build() {
  exec 9>&-
}

# need_packages PACKAGE...: installs what is missing of them.
need_packages() {
  local missing
  if [[ ${GFB_INSTALL:-yes} == no ]] || ! has_apt; then
    return
  fi
  read -ra missing <<<"$(missing_packages "$@")"
  if ((${#missing[@]} > 0)); then
    install_packages "${missing[@]}"
  fi
}

# missing_packages PACKAGE...: those that are not installed, each once.
missing_packages() {
  local present package lacking=' '
  # shellcheck disable=SC2016 # the ${} are dpkg-query's
  present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    [[ $'\n'$present$'\n' == *$'\n'"installed $package"$'\n'* || $lacking == *" $package "* ]] || lacking+="$package "
  done
  lacking=${lacking# }
  printf '%s' "${lacking% }"
}

has_apt() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null
}

install_packages() {
  local log=$root/build/apt.log as_root=() system
  local install=(apt-get install --yes --no-install-recommends -o DPkg::Lock::Timeout=300 "$@")
  if ((EUID != 0)); then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      as_root=(sudo -n)
    elif command -v sudo >/dev/null && [[ -t 0 && -t 2 ]]; then
      as_root=(sudo)
    else
      say 'missing packages; please let an administrator run, once for tools/run and tools/test'
      say "  apt-get update && apt-get install --yes --no-install-recommends $(missing_packages "$@" "${test_packages[@]}")"
      stop 'or set GFB_INSTALL=no where libraries of your own take their place (PKG_CONFIG_PATH)'
    fi
  fi
  system=$(. /etc/os-release 2>/dev/null; printf '%s %s' "${ID:-}" "${VERSION_ID:-}")
  [[ $system == 'debian 12' || $system == 'debian 13' ]] \
    || say "gfb is tested on Debian 12 and 13; ${system:-this system} is untested"
  say "installing with apt: $*"
  say '(some minutes the first time)'
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  if ! "${as_root[@]}" "${install[@]}" >"$log" 2>&1 </dev/null 9>&-; then
    say "updating apt's package list, which is missing or old"
    if ! { "${as_root[@]}" apt-get update && "${as_root[@]}" "${install[@]}"; } \
      >>"$log" 2>&1 </dev/null 9>&-; then
      tail -n 15 -- "$log" >&2
      stop "apt failed; its messages are in $log"
    fi
  fi
  say "installed with apt: $*"
  packages_changed=yes
}

# Python packages that Debian lacks, in a virtual environment that sees Debian's own; fails, in words, where pip does.
need_venv() {
  [[ ${GFB_PIP_FAILED:-no} == no ]] || return 1 # tools/test has tried, and said why
  fill_venv "$venv" "$requirements" "$(grep -o '^[a-z-]*==[^ ]*' -- "$requirements" | tr '\n' ' ')"
}

# The Python of tests and checks: that of the virtual environment, or else the system's.
python_of_tests() {
  local python=$venv/bin/python
  [[ -x $python ]] || python=$(command -v /usr/bin/python3 || command -v python3) || stop 'python3 is missing'
  printf '%s' "$python"
}

# Those of tools/studio, in one of their own: nobody else needs them.
need_studio_venv() {
  if [[ ${GFB_INSTALL:-yes} == no ]] && ! is_filled "$studio_venv" "$studio_requirements"; then
    stop 'tools/studio needs the library NiceGUI in build/studio_venv: without GFB_INSTALL=no, tools/studio --install puts it there'
  fi
  fill_venv "$studio_venv" "$studio_requirements" "$(grep -o '^nicegui==[^ ]*' -- "$studio_requirements") and what it needs (130 MB, once)" \
    || exit 3
}

# is_filled FOLDER REQUIREMENTS
is_filled() {
  base=/usr/bin/python3
  [[ -x $base ]] || base=$(command -v python3) || stop 'python3 is missing'
  wanted=$("$base" --version)$'\n'$(<"$2")
  [[ -x $1/bin/python && -f $1/installed.txt && $(<"$1/installed.txt") == "$wanted" ]]
}

# fill_venv FOLDER REQUIREMENTS NAMES: makes it where it is not as it should be; 1 where pip fails.
fill_venv() {
  local log=$root/build/pip.log base wanted
  if is_filled "$1" "$2"; then
    return
  fi
  say "installing in build/${1##*/} with pip: $3"
  rm -rf -- "$1"
  # Isolated, and from a folder of our own: neither modules nor settings of the folder in which a tool is called count.
  if ! (cd -- "$root" && "$base" -I -m venv --system-site-packages "$1" && "$1/bin/python" -I -m pip install --no-input \
    --disable-pip-version-check --require-hashes --requirement "$2") >"$log" 2>&1 </dev/null 9>&-; then
    explain_pip "$log" "$2"
    return 1
  fi
  printf '%s\n' "$wanted" >"$1/installed.txt"
}

# explain_pip LOG REQUIREMENTS: why pip failed, in our words, and behind them what of pip's own shows it.
explain_pip() {
  local log=$1 why shown='^(WARNING: Retrying|Could not fetch)'
  if grep -q 'DO NOT MATCH THE HASHES' -- "$log"; then
    why="what it got is not among the hashes of ${2#"$root/"}, which are of CPython 3.11 to 3.14 on x86-64 and 64-bit ARM:
  this is $("$base" --version) on $(uname -m). On one of those the file was changed on its way"
    shown='^ +(.* from |Expected|Got)'
  elif grep -qE 'CERTIFICATE_VERIFY_FAILED|SSLError' -- "$log"; then
    why='it does not trust the certificate of the package index. Behind a proxy that shows one of its own, name a file with it:
  export PIP_CERT=/path/to/certificates.pem'
  elif grep -qE 'ProxyError|Tunnel connection failed' -- "$log"; then
    why="the proxy does not let it through: https_proxy=${https_proxy:-${HTTPS_PROXY:-}}"
  elif grep -qE '^WARNING: Retrying|timed out|unreachable' -- "$log"; then
    why='it does not reach the package index, which it needs this once: without a network of its own a machine needs a proxy
  (export https_proxy=http://HOST:PORT) or an index of its own (export PIP_INDEX_URL=...)'
  elif grep -qE 'ensurepip|No module named pip' -- "$log"; then
    why='Python lacks it: apt-get install python3-venv'
    shown='ensurepip|No module named'
  else
    why="it finds no file for $("$base" --version) on $(uname -m), or cannot install it"
    shown='^ERROR'
  fi
  say "pip failed: $why"
  { grep -E -- "$shown" "$log" || tail -n 5 -- "$log"; } | sed -E 's/^ +//; s/^WARNING: Retrying .* after/pip: after/; s/^/  /' | cut -c1-300 \
    | awk '!seen[$0]++' | head -n 6 >&2
  say "  all its messages are in $log"
}

# build_program PRESET TARGET: configures where needed, builds, and shows errors only. The preset developer has the
# folder of release, so that tools/run runs what tools/test has tested.
build_program() {
  local name=${1/developer/release}
  local folder=$root/build/$name log=$root/build/$name.log
  command -v cmake >/dev/null || stop "cmake is missing. gfb needs $libraries"
  configure_if_needed "$1"
  if ! make_target "$folder" "$2" "$log"; then
    # A library that moved or went since, or a damaged build folder: once more from the start.
    if [[ $configured == no ]] && grep -qE '^ninja: error|could not load cache' -- "$log"; then
      say "build/$name no longer fits this machine: configuring again"
      build_again "$@" && return
    elif [[ $1 == release && $configured == no ]] && grep -q 'warnings being treated as errors' -- "$log"; then
      say 'a warning is an error here since tools/test: building again, where it is none'
      build_again "$@" && return
    fi
    grep -vE '^\[[0-9]+/[0-9]+\] ' -- "$log" >&2 || true
    stop "the build failed; all its messages are in $log"
  fi
}

# build_again PRESET TARGET, in build_program: with a cache of its own.
build_again() {
  rm -f -- "$folder/configured.txt" "$folder/CMakeCache.txt"
  configure_if_needed "$1"
  make_target "$folder" "$2" "$log"
}

make_target() {
  cmake --build "$1" --target "$2" 2>&1 9>&- | tee -- "$3" | show_progress
}

# A line now and then with the time left, none where the build is short.
show_progress() {
  local line began=$SECONDS next=$((SECONDS + 3)) done_of all
  local -a lately=("$SECONDS" 0) before=("$SECONDS" 0) # when, and how many were done: of the last half minute or more
  while IFS= read -r line; do
    if [[ $line == '['*/*']'* ]] && ((SECONDS >= next)); then
      done_of=${line%%]*}
      done_of=${done_of#[}
      all=${done_of#*/} done_of=${done_of%/*}
      if [[ $done_of =~ ^[0-9]+$ ]]; then
        say "building $done_of/$all$(time_left "$((SECONDS - began))" "$done_of" "$all" "$((SECONDS - before[0]))" "$((done_of - before[1]))")"
        if ((SECONDS - lately[0] >= 30)); then
          before=("${lately[@]}") lately=("$SECONDS" "$done_of")
        fi
      fi
      next=$((SECONDS + 10))
    fi
  done
}

# time_left SECONDS DONE ALL [SECONDS DONE]: at the pace so far, or that of the last time where it is slower, as the first steps are short ones and
# others may have begun to use the machine; nothing where that would be a guess.
time_left() {
  local left latest
  [[ $2 =~ ^[0-9]+$ && $3 =~ ^[0-9]+$ ]] || return 0
  (($1 >= 5 && $2 >= 20)) || return 0
  left=$(($1 * ($3 - $2) / $2))
  latest=$((${4:-0} * ($3 - $2) / (${5:-1} > 0 ? ${5:-1} : 1)))
  ((left >= latest)) || left=$latest
  if ((left >= 90)); then
    printf ', about %s min left' "$(((left + 30) / 60))"
  else
    printf ', about %s s left' "$left"
  fi
}

# A build folder belongs to one checkout and one set of libraries; another starts it afresh.
configure_if_needed() {
  local name=${1/developer/release} python=$venv/bin/python wanted
  local folder=$root/build/$name log=$root/build/$name.configure.log
  [[ -x $python ]] || python=$(command -v /usr/bin/python3 || command -v python3) || python=''
  wanted=$(printf '%s\n' "root $root" "PKG_CONFIG_PATH ${PKG_CONFIG_PATH:-}" \
    "CMAKE_PREFIX_PATH ${CMAKE_PREFIX_PATH:-}" "compilers ${FC:-} ${CC:-} ${FFLAGS:-} ${CFLAGS:-}")
  configured=no
  if [[ ${packages_changed:-no} == no && -f $folder/build.ninja && -f $folder/configured.txt \
    && $(<"$folder/configured.txt") == "$wanted"$'\n'"python $python" \
    && ! $root/CMakePresets.json -nt $folder/configured.txt ]] \
    && { [[ $1 != developer ]] || grep -qx 'GFB_WARNINGS_ARE_ERRORS:BOOL=ON' -- "$folder/CMakeCache.txt"; }; then
    return
  fi
  if [[ -f $folder/configured.txt && $(<"$folder/configured.txt") != "$wanted"$'\n'* ]] \
    || { [[ -f $folder/CMakeCache.txt ]] \
    && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" -- "$folder/CMakeCache.txt"; }; then
    say "build/$name is of another place or other libraries: building afresh"
    rm -rf -- "$folder"
  fi
  [[ ${packages_changed:-no} == no ]] || rm -f -- "$folder/CMakeCache.txt"
  has_apt || say "this system has no apt; CMake looks for what gfb needs: $libraries"
  say "configuring build/$name"
  if ! (cd -- "$root" && help_find_hdf5 && cmake --preset "$1" -D "GFB_PYTHON=$python") >"$log" 2>&1 9>&-; then
    sed -n '/CMake Error/,$p' -- "$log" >&2
    if grep -qiE 'could not find|not found' -- "$log"; then
      say "gfb needs $libraries"
    fi
    stop "CMake failed; all its messages are in $log"
  fi
  printf '%s\n' "$wanted" "python $python" >"$folder/configured.txt"
  configured=yes
}

# CMake asks HDF5's compiler wrapper, a script that fails in a folder with a blank in its name: there, say
# where HDF5 is.
help_find_hdf5() {
  local include library
  [[ $root == *[[:space:]]* && -z ${HDF5_ROOT:-} ]] || return 0
  include=$(pkg-config --cflags-only-I hdf5-mpi) && library=$(pkg-config --libs-only-L hdf5-mpi) || return 0
  include=${include#-I} library=${library#-L}
  export CMAKE_INCLUDE_PATH=${include%% *} CMAKE_LIBRARY_PATH=${library%% *}
}

# One thread a rank; root in a container, more ranks than cores, no ssh, no ptrace. What the user has set stays.
prepare_mpi() {
  export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=${OMPI_MCA_rmaps_base_oversubscribe:-1}
  export OMPI_MCA_hwloc_base_binding_policy=${OMPI_MCA_hwloc_base_binding_policy:-none}
  export OMPI_MCA_btl_vader_single_copy_mechanism=${OMPI_MCA_btl_vader_single_copy_mechanism:-none}
  export OMPI_MCA_orte_execute_quiet=${OMPI_MCA_orte_execute_quiet:-1}
  if ! command -v ssh >/dev/null && ! command -v rsh >/dev/null; then
    export OMPI_MCA_plm_rsh_agent=${OMPI_MCA_plm_rsh_agent:-sh}
  fi
}
