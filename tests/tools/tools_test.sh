#!/usr/bin/env bash
# Tests tools/run and tools/check in a copy whose name has a blank; gfb, cmake and mpiexec are stand-ins that
# tell how they were called.
#   tools_test.sh PROJECT_FOLDER
set -uo pipefail

project=$(cd -- "$1" && pwd -P)
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
copy="$scratch/a copy"
passed=0 failed=0

# expect STATUS TEXT CLAIM: of the last call.
expect() {
  if [[ $status == "$1" && $said == *"$2"* ]]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf 'FAILED: %s: status %s with "%s" expected, found %s with:\n%s\n' "$3" "$1" "$2" "$status" "$said"
  fi
}

call() {
  said=$("$@" 2>&1 </dev/null)
  status=$?
}

mkdir -p -- "$copy/src" "$copy/build" "$scratch/bin" "$scratch/here"
cp -R -- "$project/tools" "$project/CMakePresets.json" "$copy/"
cat >"$scratch/gfb" <<'END'
#!/usr/bin/env bash
printf 'gfb'; printf ' [%s]' "$@"; printf ' threads %s\n' "$OMP_NUM_THREADS"
exit "${GFB_STATUS:-0}"
END
cat >"$scratch/bin/cmake" <<'END'
#!/usr/bin/env bash
if [[ $1 == --preset ]]; then
  echo configure >>"$SCRATCH/calls"
  mkdir -p "build/$2" && touch "build/$2/build.ninja"
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >"build/$2/CMakeCache.txt"
elif grep -q '^GFB_WARNINGS_ARE_ERRORS:BOOL=ON' "$2/CMakeCache.txt"; then
  printf '[1/2] fine\nfilm.c: error: unused\ncc1: all warnings being treated as errors\n'
  exit 1
elif [[ -e $SCRATCH/broken ]]; then
  printf '[1/2] fine\nFAILED: film.o\nError: no such variable\n'
  exit 1
else
  echo "$4" >>"$SCRATCH/built"
  cp "$SCRATCH/gfb" "$2/gfb"
fi
END
cat >"$scratch/bin/mpiexec" <<'END'
#!/usr/bin/env bash
printf 'mpiexec %s %s ' "$1" "$2"
shift 2
exec "$@"
END
printf '#!/bin/sh\necho ctest "$@"\nexit "${CTEST_STATUS:-0}"\n' >"$scratch/bin/ctest"
chmod +x "$scratch/gfb" "$scratch/bin/"*
export SCRATCH=$scratch
normal_path=$PATH
export PATH=$scratch/bin:$PATH GFB_INSTALL=no
unset OMP_NUM_THREADS
cd -- "$scratch/here" || exit 1
run="$copy/tools/run"
touch 'my case.nml'

# --- tools/run ---
call "$run"
expect 0 '[--output] [results/gu2020_bearing] ['"$copy"'/inputs/gu2020_bearing.nml] threads 1' \
  'without arguments the main job runs'
expect 0 'results are in results/gu2020_bearing' 'says where the results are'
call "$run" -n 3 'my case.nml' --output 'to here'
expect 0 'mpiexec -n 3 gfb [--output] [to here] [my case.nml]' 'ranks, output folder and blanks'
call "$run" --check 'my case.nml' --strange
expect 0 'gfb [--strange] [--check] [my case.nml]' 'other options reach gfb'
call "$run" --version
expect 0 'gfb [--version] threads' 'an option alone goes to gfb alone'
GFB_STATUS=2 call "$run" 'my case.nml'
expect 2 'not converged; what was reached is in results/my case' 'status 2 is passed on'
GFB_STATUS=1 call "$run" 'my case.nml' --output none/made
expect 1 'gfb' 'status 1 is passed on'
[[ ! -e none/made ]] || status=an-empty-folder
expect 1 '' 'no empty folder stays after wrong input'
GFB_STATUS=3 call "$run" -n2 'my case.nml'
expect 3 'mpiexec -n 2' 'status 3 is passed on through mpiexec'
OMP_NUM_THREADS=5 call "$run"
expect 0 'threads 5' 'what the user set stays'
for wrong in '-n 0' '-n x' '-n' 'a.nml b.nml' '--output'; do
  # shellcheck disable=SC2086 # two words are meant
  call "$run" $wrong
  expect 1 'tools/run:' "refuses $wrong"
done
call wc -l <"$scratch/calls"
said=$(wc -l <"$scratch/calls")
expect 0 1 'configured once for all calls'
echo 'GFB_WARNINGS_ARE_ERRORS:BOOL=ON' >>"$copy/build/release/CMakeCache.txt"
call "$run"
expect 0 'results are in' 'a warning that tools/test takes for an error stops no run'
expect 0 'building again, where it is none' 'and is told'
mv -- "$copy" "$scratch/moved"
call "$scratch/moved/tools/run"
expect 0 'building afresh' 'a moved checkout is built afresh'
mv -- "$scratch/moved" "$copy"
touch "$scratch/broken"
call "$run"
expect 3 'Error: no such variable' 'a build that fails shows the error'
[[ $said != *'fine'* ]] || status=noise
expect 3 'FAILED: film.o' 'a build that fails shows nothing else'
rm -- "$scratch/broken"

# --- tools/test NAME ---
rm -- "$scratch/built"
call "$copy/tools/test" unit_formulas_film unit_base --verbose
expect 0 '--tests-regex ^(unit_formulas_film|unit_base)$ --verbose' 'tests by name run, with options of ctest'
expect 0 "--test-dir $copy/build/release " 'in the build folder of release'
[[ $said != *'are in order'* ]] || status=checked
said=$(<"$scratch/built")
[[ $said != *all* ]] || status=built-all
expect 0 $'unit_formulas_film\nunit_base' 'only what they need is built, and nothing checked'
CTEST_STATUS=8 call "$copy/tools/test" tools_mutants
expect 8 'tools_mutants' 'status of ctest is passed on'
said=$(tail -n 1 "$scratch/built")
expect 8 all 'a test that runs gfb needs it'

# --- tools/studio ---
call "$copy/tools/studio" --install
expect 3 'tools/studio --install puts it there' 'installs nothing where nothing is to be installed'
# shellcheck disable=SC2016 # the inner shell's
GFB_INSTALL=yes PIP_NO_INDEX=1 PIP_FIND_LINKS='' call bash -c 'source "$1/tools/setup.sh"; need_studio_venv' bash "$copy"
expect 3 'pip failed: it finds no file for Python' 'says what is missing without an index'
[[ ! -e $copy/build/studio_venv/installed.txt ]] || status=half-a-library
expect 3 'installing in build/studio_venv' 'and the next start tries again'

# --- the time left in a build: the pace so far, the last one where it is slower, and no guess from its first seconds or steps ---
# shellcheck disable=SC2016 # the inner shell's
call bash -c 'source "$1/tools/setup.sh"; for one in "20 100 300" "60 100 400" "60 200 400 30 20" "60 200 400 30 150" "2 100 300" "20 5 300"; do echo "<$(time_left $one)>"; done' bash "$copy"
expect 0 $'<, about 40 s left>\n<, about 3 min left>\n<, about 5 min left>\n<, about 60 s left>\n<>\n<>' 'the time left in a build'

# --- why pip fails: messages of pip 23 behind a proxy that is not there, with another certificate, without a network, for another Python ---
explain() {
  printf '%s\n' "$1" >"$scratch/pip.log"
  # shellcheck disable=SC2016 # the inner shell's
  call bash -c 'source "$1/tools/setup.sh"; base=python3; explain_pip "$2" "$1/tools/requirements.txt"' bash "$copy" "$scratch/pip.log"
}
retry='WARNING: Retrying (Retry(total=0, connect=None, read=None, redirect=None, status=None)) after connection broken by'
none='ERROR: Could not find a version that satisfies the requirement vtk==9.7.2 (from versions: none)'
explain "$retry 'ProxyError('Cannot connect to proxy.', NewConnectionError('<object>: [Errno 111] Connection refused'))': /simple/vtk/
$none"
expect 0 'the proxy does not let it through' 'a proxy'
explain "$retry 'SSLError(SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED] self-signed certificate (_ssl.c:1006)'))': /simple/vtk/
$none"
expect 0 'export PIP_CERT=' 'a certificate'
expect 0 'self-signed certificate' "and pip's own words"
explain "$retry 'NewConnectionError('<object>: Failed to establish a new connection: [Errno -2] Name or service not known')': /simple/vtk/
$none"
expect 0 'it does not reach the package index' 'no network'
[[ $said != *'from versions: none'* ]] || status=a-wrong-track
expect 0 '' 'and not that there were no such package'
explain 'ERROR: THESE PACKAGES DO NOT MATCH THE HASHES FROM THE REQUIREMENTS FILE. Examine them carefully; someone may have tampered with them.
    vtk==9.7.2 from https://example.org/vtk-9.7.2-cp315-cp315-linux_x86_64.whl (from -r requirements.txt (line 7)):
        Expected sha256 44a8
             Got        2b1d'
expect 0 'CPython 3.11 to 3.14 on x86-64 and 64-bit ARM' 'a Python without hashes'
expect 0 'vtk-9.7.2-cp315' 'and which file it was'
[[ $said != *tampered* ]] || status=frightens
expect 0 '' 'without frightening'

# --- packages, where the user is not root: those of both commands at once ---
mkdir -- "$scratch/apt"
for name in dpkg-query apt-get sudo; do
  printf '#!/bin/sh\nexit 1\n' >"$scratch/apt/$name"
done
chmod +x "$scratch/apt/"*
chmod 755 "$scratch"
as_user=()
((EUID != 0)) || as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
# shellcheck disable=SC2016 # the inner shell's
GFB_INSTALL=yes PATH=$scratch/apt:$PATH call "${as_user[@]}" bash -c 'source "$1/tools/setup.sh"; need_packages "${run_packages[@]}"' bash "$copy"
for name in gfortran petsc-dev python3-venv hunspell-en-gb; do
  expect 3 " $name" "packages of tools/run and tools/test: $name"
done

# --- tools/check_petsc ---
for wrong in '--version 3.26' '--version newest' '--jobs 0' '--folder' ''; do # its own folder has a blank here
  # shellcheck disable=SC2086 # several words
  call "$copy/tools/check_petsc" $wrong
  expect 1 'tools/check_petsc:' "check_petsc refuses '$wrong'"
done

# --- tools/check_systems ---
for wrong in '11' '--jobs 0' '--folder' '13 amd64' ''; do
  # shellcheck disable=SC2086 # several words
  call "$copy/tools/check_systems" $wrong
  expect 1 'tools/check_systems:' "check_systems refuses '$wrong'"
done

# --- tools/check: with the real findent and fortitude, where the build folder has them ---
venv=$project/build/venv
if [[ -x $venv/bin/fortitude ]] && command -v findent >/dev/null; then
  export PATH=$normal_path
  ln -s -- "$venv" "$copy/build/venv"
  [[ ! -d $project/build/mypy ]] || cp -R -- "$project/build/mypy" "$copy/build/" # what is known of the same files
  cat >"$copy/src/good.f90" <<'END'
!> Good.
module gfb_good
  implicit none (type, external)
  private
end module gfb_good
END
  call "$copy/tools/check"
  expect 0 'are in order' 'good sources pass'
  # Everything that is refused, in one call: each has words of its own.
  mkdir -p -- "$copy/inputs"
  sed 's/^  private/   private/' "$copy/src/good.f90" >"$copy/src/indent.f90"
  sed 's/ (type, external)//' "$copy/src/good.f90" >"$copy/src/habit.f90"
  sed "s/Good/$(printf 'long%.0s' {1..30})/" "$copy/src/good.f90" >"$copy/src/line.f90"
  printf 'a\tb\n' >"$copy/inputs/bad.nml"
  printf 'a \nsee /%s/me/file\n' home >"$copy/README.md"
  printf 'if True\n' >"$copy/tools/bad.py"
  printf 'from gfb import run\n\nGAP: str = run("a.nml")["minimum_gap"]\n' >"$copy/tools/gfb/bad.py"
  # shellcheck disable=SC2016 # as it stands
  printf '#!/usr/bin/env bash\nls $1\n' >"$copy/tools/bad.sh"
  call "$copy/tools/check"
  expect 1 'src/indent.f90 is not indented' 'a bad indent'
  expect 1 'src/habit.f90:3:3: C003' 'a rule of fortitude'
  expect 1 'src/line.f90:1:101: S001' 'a long line'
  expect 1 'check: tabs' 'a tab'
  expect 1 'check: trailing blanks' 'a trailing blank'
  expect 1 "check: a path of somebody's machine" 'a path of a machine'
  expect 1 'check: a Python file does not compile' 'a broken Python file'
  failures=6
  if [[ -x $venv/bin/mypy ]]; then
    expect 1 'bad.py:3: error' 'words where there is a number'
    expect 1 'check: mypy complains' 'wrong types'
    failures=7
  fi
  if command -v shellcheck >/dev/null; then
    expect 1 'check: shellcheck complains' 'a careless script'
    failures=$((failures + 1))
  fi
  expect 1 "check: $failures of its checks failed" 'nothing else'
  rm -- "$copy/src/"{indent,habit,line}.f90 "$copy/inputs/bad.nml" "$copy/README.md" "$copy/tools/bad."{py,sh} "$copy/tools/gfb/bad.py"
  sed 's/^  private/   private  /' "$copy/src/good.f90" >"$copy/src/bad.f90"
  call "$copy/tools/check" --fix
  expect 0 'indented src/bad.f90' '--fix repairs indent and blanks'
  # What needs no package of pip is checked and tested where pip fails; the call ends with a failure all the same.
  rm -- "$copy/build/venv"
  PATH=$scratch/bin:$normal_path PIP_NO_INDEX=1 PIP_FIND_LINKS='' call "$copy/tools/test" -L unit
  expect 3 'pip failed: ' 'pip fails'
  expect 3 'habits of Fortran are not looked at' 'without fortitude the rest is checked'
  expect 3 'types of Python are not looked at' 'and without mypy'
  expect 3 'are in order' 'and found in order'
  expect 3 '-LE ^(hard|release|long)$ -L unit' 'and the tests run, without those of other labels'
  expect 3 'left out, as pip failed' 'and what was left out stands at the end'
else
  echo 'findent or fortitude is not at hand: tools/check is not tested'
fi

printf '%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
