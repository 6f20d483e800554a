#!/usr/bin/env python3
"""The forms in which others write namelists say the same as the plain one: to gfb, and in its echo of every value used.

    namelist_forms.py ECHO_EXECUTABLE                   the legal forms of Fortran, and marks of other systems; the echo of every
                                                        file of inputs/ is a case that has the same echo
    namelist_forms.py --f90nml GFB_EXECUTABLE ECHO_EXECUTABLE
                                                        every file of inputs/, read and written again by f90nml (PyPI, into build/f90nml)
"""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SECONDS = 900

PLAIN = """&scene
  title = 'forms', analysis = 'fixed_position'
/
&bearing
  radius = 19.05e-3, length = 38.1e-3, clearance = 31.8e-6
/
&gas
  viscosity = 1.95e-5, ambient_pressure = 1.0135e5
/
&operation
  speed_rpm = 30000.0, eccentricity = 1.5e-5, 0.25e-5
/
&sweep
  parameter = 'tilt_x', values = 0.0, 1.0e-5, 2.0e-5, 3.0e-5, friction_memory = .false.
/
&model
  foil = 'rigid'
/
"""
VALUES = "values = 0.0, 1.0e-5, 2.0e-5, 3.0e-5"


def replaced(*pairs):
    """The plain text with parts replaced, each of which it has."""
    text = PLAIN
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text.encode()


def forms():
    """Name and bytes of files that say what the plain one says."""
    vector = "eccentricity = 1.5e-5, 0.25e-5"
    yield "a section", replaced((vector, "eccentricity(1:2) = 1.5e-5, 0.25e-5"))
    yield "a section with blanks", replaced((vector, "eccentricity ( 1 :\t2 ) = 1.5e-5, 0.25e-5"))
    yield "a section without ends", replaced((vector, "eccentricity(:) = 1.5e-5, 0.25e-5"))
    yield "a section without a begin", replaced((vector, "eccentricity(:2) = 1.5e-5, 0.25e-5"))
    yield "a section from its end", replaced((vector, "eccentricity(2:1:-1) = 0.25e-5, 1.5e-5"))
    yield "single indices", replaced((vector, "eccentricity(2) = 0.25e-5, eccentricity(1) = 1.5e-5"))
    yield "a stride", replaced((VALUES, "values(1:4:2) = 0.0, 2.0e-5, values(2::2) = 1.0e-5, 3.0e-5"))
    yield "two sections", replaced((VALUES, "values(3:4) = 2.0e-5, 3.0e-5\n values(1:2) = 0.0\n 1.0e-5"))
    yield "a repeat in a section", replaced((VALUES, "values(1:1) = 1*0.0, values(2:) = 1.0e-5 2.0e-5 3.0e-5"))
    yield "$group and $end", replaced(("&", "$"), ("\n/", "\n$end"))
    yield "$group and a slash", replaced(("&", "$"))
    yield "&END", replaced(("\n/", " &END"))
    yield "capitals and d", replaced(("radius", "RADIUS"), ("&gas", "&GAS"), ("31.8e-6", "31.8D-6"))
    for false in (".FALSE.", ".false", "F", ".f", "false"):
        yield f"the logical {false}", replaced((".false.", false))
    yield "a final Ctrl-Z", replaced() + b"\x1a"
    yield "Ctrl-Z and a line's end", replaced() + b"\x1a\r\n"
    yield "lines of Windows", replaced(("\n", "\r\n")) + b"\x1a"
    yield "lines of an old Macintosh", replaced(("\n", "\r"))
    yield "the mark of UTF-8", b"\xef\xbb\xbf" + replaced()


def echo(program, path):
    """Every value used, as the program prints them; what is wrong where it prints none."""
    done = subprocess.run([program, str(path)], stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=SECONDS,
                          check=False)
    return done.stdout if done.returncode == 0 else f"status {done.returncode}: {done.stderr[-500:]}"


def check_forms(program):
    """What is wrong with the forms, one a line."""
    with tempfile.TemporaryDirectory() as name:
        path = pathlib.Path(name)/"case.nml"
        path.write_bytes(PLAIN.encode())
        plain, cases = echo(program, path), list(forms())
        if "eccentricity = " not in plain:
            return [f"the plain form: {plain}"], len(cases)
        wrong = []
        for form, text in cases:
            path.write_bytes(text)
            found = echo(program, path)
            if found != plain:
                wrong.append(f"{form}: {found if found.startswith('status') else 'another echo'}")
        return wrong, len(cases)


def values_of(text):
    """Lines of an echo without what they mean and whether they are defaults."""
    return [line.split(" ! ")[0] for line in text.splitlines() if not line.strip().startswith("!")]


def check_echoes(program):
    """What is wrong with the echoes of all inputs as case files, one a line."""
    wrong, inputs = [], sorted([*(ROOT/"inputs").glob("*.nml"), *(ROOT/"inputs/machines").glob("*.nml")])
    with tempfile.TemporaryDirectory() as name:
        path = pathlib.Path(name)/"used.nml"
        for source in inputs:
            first = echo(program, source)
            path.write_text(first, encoding="utf-8")
            again = echo(program, path)
            if "&scene" not in first or values_of(again) != values_of(first):
                wrong.append(f"the echo of {source.name}: {again if again.startswith('status') else 'another echo'}")
    return wrong, len(inputs)


def rewrite(folder):
    """In f90nml's Python: reads every input and writes it again, as it is, and with its lists as sections."""
    import f90nml
    for path in sorted((ROOT/"inputs").glob("*.nml")):
        groups = f90nml.read(path)
        groups.write(pathlib.Path(folder)/path.name)
        for group in groups.values():
            for key, value in group.items():
                if isinstance(value, list):
                    group.start_index[key] = [1]
        groups.write(pathlib.Path(folder)/f"sections_{path.name}")


def check_f90nml(gfb, program):
    """What is wrong with inputs that f90nml has written, one a line; None where there is no f90nml."""
    sys.path.insert(0, str(ROOT/"tests/verification"))
    from pypi import python_with
    python = python_with("f90nml")
    if python is None:
        return None, 0
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        subprocess.run([str(python), __file__, "--rewrite", name], check=True, timeout=SECONDS)
        written = sorted(pathlib.Path(name).glob("*.nml"))
        inputs = sorted((ROOT/"inputs").glob("*.nml"))
        if len(written) != 2*len(inputs) or not any("(1:" in path.read_text(encoding="utf-8") for path in written):
            wrong.append(f"{len(written)} files written of {len(inputs)}, or no section among them")
        for source in inputs:
            plain = echo(program, source)
            for path in (pathlib.Path(name)/source.name, pathlib.Path(name)/f"sections_{source.name}"):
                found = echo(program, path)
                if found != plain:
                    wrong.append(f"{path.name}: {found if found.startswith('status') else 'another echo'}")
        sections = [path for path in written if path.name.startswith("sections_")]
        done = subprocess.run([gfb, "--check", "--groups", "1", *map(str, sections)],
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8",
                              timeout=SECONDS, check=False)
        if done.returncode:
            wrong.append(f"gfb --check ends with {done.returncode}: {done.stderr[-500:]}")
        wrong += [f"{path.name}: gfb --check does not say that it is in order" for path in sections
                  if f"{path} is in order" not in done.stdout]
    return wrong, len(written)


def main():
    if sys.argv[1:2] == ["--rewrite"]:
        rewrite(sys.argv[2])
        return
    if sys.argv[1:2] == ["--f90nml"]:
        wrong, number = check_f90nml(*sys.argv[2:])
        if wrong is None:
            print("skipped: f90nml cannot be installed here (tests/requirements-f90nml.txt: PyPI)")
            sys.exit(77)
    else:
        wrong, number = check_forms(sys.argv[1])
        more, inputs = check_echoes(sys.argv[1])
        wrong, number = wrong + more, number + inputs
    for line in wrong:
        print("FAILED", line)
    print(f"{number} files, {len(wrong)} failed")
    sys.exit(1 if wrong or not number else 0)


if __name__ == "__main__":
    main()
