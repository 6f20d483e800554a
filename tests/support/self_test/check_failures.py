"""Runs tests that must all fail and checks that each is reported with its expected words.

    check_failures.py FILE.pf COMMAND ...

A stand-in that lets everything pass is caught here.
"""
import re
import subprocess
import sys


def expectations(path):
    """Name of each test and the words it must fail with."""
    expected, name, waiting = {}, None, False
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip().startswith("@test"):
                waiting = True
            found = re.match(r"\s*subroutine (\w+)", line)
            if found:
                name = found.group(1) if waiting else None
                waiting = False
                if name:
                    expected[name] = []
            found = re.match(r"\s*! expect: (.*)", line)
            if found and name:
                expected[name].append(found.group(1).strip())
    return expected


def main():
    path, command = sys.argv[1], sys.argv[2:]
    module = re.search(r"(\w+)\.pf$", path).group(1)
    expected = expectations(path)
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                         timeout=900, check=False)
    lines = run.stdout.splitlines()
    mistakes = []
    if run.returncode == 0:
        mistakes.append("exit status 0 although tests failed")
    for name, words in expected.items():
        if not words:
            mistakes.append(f"{name}: says no '! expect:'")
        if not any(re.match(rf"failed +{module}\.{name}\b", line) for line in lines):
            mistakes.append(f"{name}: was not reported as failed")
        # A report goes on, indented, after its first line.
        report, inside = [], False
        for line in lines:
            if not line.startswith("  "):
                inside = re.match(rf"FAILED {module}\.{name}\b", line) is not None
            if inside:
                report.append(line)
        for word in words:
            if word not in "\n".join(report):
                mistakes.append(f"{name}: '{word}' is not in its report")
        if words != ["more ranks than were started"] and f"{module}.pf:" not in "\n".join(report):
            mistakes.append(f"{name}: its report lacks file and line")
    if f"{len(expected)} tests, {len(expected)} failed, 0 disabled" not in lines:
        mistakes.append(f"the closing count is not {len(expected)} of {len(expected)}")
    if mistakes:
        print(run.stdout)
        sys.exit("\n".join(mistakes))
    print(f"all {len(expected)} tests failed as they must")


if __name__ == "__main__":
    main()
