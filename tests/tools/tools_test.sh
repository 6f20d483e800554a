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
  cp "$SCRATCH/gfb" "$2/gfb"
fi
END
cat >"$scratch/bin/mpiexec" <<'END'
#!/usr/bin/env bash
printf 'mpiexec %s %s ' "$1" "$2"
shift 2
exec "$@"
END
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

# --- tools/studio ---
call "$copy/tools/studio" --install
expect 3 'tools/studio --install puts it there' 'installs nothing where nothing is to be installed'
GFB_INSTALL=yes PIP_NO_INDEX=1 PIP_FIND_LINKS='' call bash -c 'source "$1/tools/setup.sh"; need_studio_venv' bash "$copy"
expect 3 'pip failed, which needs the network this once' 'says what is missing without a network'
[[ ! -e $copy/build/studio_venv/installed.txt ]] || status=half-a-library
expect 3 'installing in build/studio_venv' 'and the next start tries again'

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
  if command -v shellcheck >/dev/null; then
    expect 1 'check: shellcheck complains' 'a careless script'
    failures=7
  fi
  expect 1 "check: $failures of its checks failed" 'nothing else'
  rm -- "$copy/src/"{indent,habit,line}.f90 "$copy/inputs/bad.nml" "$copy/README.md" "$copy/tools/bad."{py,sh}
  sed 's/^  private/   private  /' "$copy/src/good.f90" >"$copy/src/bad.f90"
  call "$copy/tools/check" --fix
  expect 0 'indented src/bad.f90' '--fix repairs indent and blanks'
else
  echo 'findent or fortitude is not at hand: tools/check is not tested'
fi

printf '%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
