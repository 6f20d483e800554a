#!/usr/bin/env python3
"""Turns .pf test files into Fortran, for the stand-in for pFUnit.

    pf_to_f90.py module FILE.pf --output FILE.F90
    pf_to_f90.py driver FILE.pf ... --name NAME --output DRIVER.f90
                 [--ranks] [--use MODULE --initialize SUBROUTINE]

Knows @test, @test(npes=[1, 2]), @before, @after, @disable (after @test), and the asserts listed
below, each on one line. A failed @assert... leaves the test; a failed @mpiAssert... only counts,
and the test goes on, so that no rank waits for one that left. Anything else is refused, with file
and line, so that a file accepted here means the same under pFUnit.
"""
import argparse
import os
import re
import sys

ASSERTS = {name.lower(): name for name in (
    "assertEqual assertNotEqual assertTrue assertFalse assertLessThan assertLessThanOrEqual "
    "assertGreaterThan assertGreaterThanOrEqual assertRelativelyEqual assertIsNaN assertIsFinite "
    "assertFail").split()}
ANNOTATION = re.compile(r"^\s*@\s*(\w+)\s*(.*?)\s*$")
SUBROUTINE = re.compile(r"^\s*(?:(?:recursive|impure|pure|module)\s+)*"
                        r"subroutine\s+(\w+)\s*(?:\(([^)]*)\))?", re.IGNORECASE)
FUNCTION = re.compile(r"^\s*(?!end\b)(?:[\w*]+(?:\([^)]*\))?[\s,]+)*function\s+\w+\s*\(",
                      re.IGNORECASE)
END = re.compile(r"^\s*end\s*(subroutine|function)\b", re.IGNORECASE)
MODULE = re.compile(r"^\s*module\s+(?!procedure\b|subroutine\b|function\b)(\w+)\s*(?:!.*)?$",
                    re.IGNORECASE)
PRIVATE = re.compile(r"^\s*private\s*(?:!.*)?$", re.IGNORECASE)
RANKS = re.compile(r"^\(\s*npes\s*=\s*\[\s*(\d+(?:\s*,\s*\d+)*)\s*\]\s*\)$", re.IGNORECASE)


class Mistake(Exception):
    """A test file that cannot be used, and where."""

    def __init__(self, path, line, words):
        super().__init__(f"{path}:{line}: error: {words}")


class Procedure:
    """A test, or what runs before or after each test."""

    def __init__(self, role, line, ranks=()):
        self.role = role            # test, before, after
        self.line = line            # of the annotation
        self.ranks = ranks          # as many as the test asks for, () without npes
        self.disabled = False
        self.name = None
        self.argument = None        # name of the dummy argument, where there is one


class TestFile:
    """A .pf file: its Fortran lines and its tests."""

    def __init__(self, path):
        self.path = path
        self.base = os.path.splitext(os.path.basename(path))[0]
        self.module = None
        self.procedures = []
        self.lines = []
        self.pending = None         # annotation that waits for its subroutine
        self.stack = []             # procedures that are open: Procedure, or None for helpers
        self.in_interface = 0
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file.read().splitlines(), 1):
                self.lines.append(self.translate(number, line))
        self.check()

    def fail(self, number, words):
        raise Mistake(self.path, number, words)

    def translate(self, number, line):
        """One line of Fortran for one line of the file, so that line numbers stay."""
        match = ANNOTATION.match(line)
        if not match:
            self.follow(number, line)
            return line
        word, rest = match.group(1).lower(), match.group(2)
        if word in ASSERTS or (word.startswith("mpi") and word[3:] in ASSERTS):
            return self.translate_assert(number, line, word, rest)
        self.translate_annotation(number, word, rest)
        return "!" + line

    def translate_annotation(self, number, word, rest):
        if word == "disable":
            if not (self.pending and self.pending.role == "test"):
                self.fail(number, "@disable must follow @test")
            if rest:
                self.fail(number, f"@disable takes nothing: '{rest}'")
            self.pending.disabled = True
            return
        if word not in ("test", "before", "after"):
            self.fail(number, f"unknown annotation @{word}")
        if self.pending:
            self.fail(number, f"@{word} where the subroutine of line "
                              f"{self.pending.line} was expected")
        if self.stack:
            self.fail(number, f"@{word} inside a procedure")
        ranks = ()
        if rest:
            match = RANKS.match(rest) if word == "test" else None
            if not match:
                self.fail(number, f"'@{word} {rest}': only @test(npes=[1, 2]) may have arguments")
            ranks = tuple(int(count) for count in match.group(1).split(","))
            if min(ranks) < 1:
                self.fail(number, "npes counts from 1")
        self.pending = Procedure(word, number, ranks)

    def translate_assert(self, number, line, word, rest):
        current = self.stack[-1] if self.stack else None
        if current is None:
            self.fail(number, "an assert must stand in a @test, @before or @after procedure itself")
        self.check_arguments(number, rest)
        goes_on = word not in ASSERTS
        if goes_on and current.argument is None:
            self.fail(number, f"@{word} needs a test with npes")
        name = ASSERTS[word[3:] if goes_on else word]
        indent = line[:len(line) - len(line.lstrip())]
        place = f"location=SourceLocation('{os.path.basename(self.path)}', {number})"
        call = f"{indent}call {name}({rest[1:-1].strip()}, {place})"
        return call if goes_on else f"{call}; if (anyExceptions()) return"

    def check_arguments(self, number, rest):
        """The parentheses must close at the end of the line."""
        depth, quote = 0, ""
        for position, letter in enumerate(rest):
            if quote:
                quote = "" if letter == quote else quote
            elif letter in "'\"":
                quote = letter
            elif letter == "(":
                depth += 1
            elif letter == ")":
                depth -= 1
            if depth == 0 and not quote:
                if position < len(rest) - 1:
                    self.fail(number, "nothing may follow an assert on its line, no comment either")
                if not rest[1:-1].strip():
                    self.fail(number, "an assert needs arguments")
                return
        self.fail(number, "an assert must stand on one line")

    def follow(self, number, line):
        """Notes where modules and procedures begin and end."""
        if not line.strip() or line.lstrip().startswith("!"):
            return
        if re.match(r"^\s*(abstract\s+)?interface\b", line, re.IGNORECASE):
            self.in_interface += 1
        elif re.match(r"^\s*end\s*interface\b", line, re.IGNORECASE):
            self.in_interface -= 1
        elif self.in_interface:
            return
        elif END.match(line):
            if self.stack:
                self.stack.pop()
        elif SUBROUTINE.match(line):
            self.open_subroutine(number, SUBROUTINE.match(line))
        elif self.pending:
            self.fail(number, "expected the subroutine of the annotation in line "
                              f"{self.pending.line}")
        elif FUNCTION.match(line):
            self.stack.append(None)
        elif MODULE.match(line):
            if self.module is None:
                self.module = MODULE.match(line).group(1)
                if self.module.lower() != self.base.lower():
                    self.fail(number, f"module {self.module} must be named {self.base}, "
                                      "as its file")
            else:
                self.fail(number, "one module a file")
        elif PRIVATE.match(line) and not self.stack:
            self.fail(number, "tests must be public: no bare 'private'")

    def open_subroutine(self, number, match):
        procedure = self.pending
        self.pending = None
        self.stack.append(procedure)
        if procedure is None:
            return
        procedure.name = match.group(1)
        arguments = [word.strip() for word in (match.group(2) or "").split(",") if word.strip()]
        if len(arguments) > 1:
            self.fail(number, f"{procedure.name} has more than one argument")
        procedure.argument = arguments[0] if arguments else None
        if procedure.role == "test" and bool(procedure.ranks) != bool(arguments):
            self.fail(number, "a test has an argument if, and only if, it has npes")
        if self.module is None:
            self.fail(number, f"{procedure.name} must stand in a module named {self.base}")
        self.procedures.append(procedure)

    def tests(self):
        return [one for one in self.procedures if one.role == "test"]

    def fixture(self, role):
        found = [one for one in self.procedures if one.role == role]
        if len(found) > 1:
            self.fail(found[1].line, f"a second @{role}")
        return found[0] if found else None

    def check(self):
        """What can be said only at the end of the file."""
        if self.pending:
            self.fail(self.pending.line, "no subroutine follows the annotation")
        if self.stack:
            self.fail(len(self.lines), "every procedure must close with 'end subroutine' "
                                       "or 'end function'")
        if not self.tests():
            self.fail(len(self.lines), "no @test in the file")
        seen = {}
        for one in self.tests():
            if one.name.lower() in seen:
                self.fail(one.line, f"a second test named {one.name}")
            seen[one.name.lower()] = one
            for fixture in (self.fixture("before"), self.fixture("after")):
                if fixture and bool(fixture.argument) != bool(one.argument):
                    self.fail(fixture.line, f"@{fixture.role} must take the arguments of every "
                                            f"test; {one.name} differs")


def module_text(path):
    """The Fortran of one test file."""
    test_file = TestFile(path)
    return f'#line 1 "{path}"\n' + "\n".join(test_file.lines) + "\n"


def driver_text(options):
    """A main program that runs the tests of all files."""
    files = [TestFile(path) for path in options.files]
    uses, calls = [], []
    kind = "mpi_test_run_type" if options.ranks else "test_run_type"
    start = "call run%open()" if options.ranks else "call run%read_command_line()"
    for at, test_file in enumerate(files, 1):
        renames = []
        fixtures = ""
        for role in ("before", "after"):
            fixture = test_file.fixture(role)
            if fixture:
                renames.append(f"{role}_{at} => {fixture.name}")
                fixtures += f", {role}={role}_{at}"
        for count, test in enumerate(test_file.tests(), 1):
            name = f"'{test_file.base}.{test.name}'"
            if test.disabled:
                calls.append(f"call run%skip({name})")
                continue
            local = f"test_{at}_{count}"
            renames.append(f"{local} => {test.name}")
            if test.ranks and not options.ranks:
                raise Mistake(test_file.path, test.line,
                              "@test(npes=...) needs MAX_PES in its CMake call")
            if not test.ranks:
                runner = "run_alone" if options.ranks else "run_plain_test"
                calls.append(f"call {runner}(run, {name}, {local}{fixtures})")
            for ranks in test.ranks:
                calls.append(f"call run_on_ranks(run, {name}, {ranks}, {local}{fixtures})")
        uses += [f"use {test_file.module}, only: {rename}" for rename in renames]
    found = [re.match(r"call (\w+)\(run,", call) for call in calls]
    runners = sorted({match.group(1) for match in found if match})
    module = "gfb_mpi_test_run" if options.ranks else "gfb_test_run"
    uses.insert(0, f"use {module}, only: {', '.join([kind] + runners)}")
    if options.initialize:
        uses.append(f"use {options.use}, only: {options.initialize}")
        calls.insert(0, f"call {options.initialize}()")
    finish = "call run%finish()" if options.ranks else "call run%close()"
    body = uses + ["implicit none (type, external)", f"type({kind}) :: run", "", start]
    body += calls + [finish]
    lines = [f"! Generated from {', '.join(os.path.basename(path) for path in options.files)}"]
    lines += [f"program {options.name}"] + ["  " + line if line else "" for line in body]
    return "\n".join(lines + [f"end program {options.name}"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=("module", "driver"))
    parser.add_argument("files", nargs="+")
    parser.add_argument("--output", required=True)
    parser.add_argument("--name", help="name of the driver's program")
    parser.add_argument("--ranks", action="store_true", help="the driver starts MPI")
    parser.add_argument("--use", help="module of the subroutine to call before the tests")
    parser.add_argument("--initialize", help="subroutine to call before the tests")
    options = parser.parse_args()
    try:
        text = module_text(options.files[0]) if options.what == "module" else driver_text(options)
    except (Mistake, OSError, UnicodeDecodeError) as mistake:
        sys.exit(str(mistake))
    with open(options.output, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
