#!/usr/bin/env python3
"""A scene from nothing: templates that run unchanged, keys and results explained, a case from the standard input."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import GFB, MPIEXEC, Checks  # noqa: E402

ANALYSES = ("equilibrium", "fixed_position", "strip", "modes", "linear_dynamics", "load_capacity", "lift_off",
            "misalignment_allowance", "transient", "periodic", "thrust", "machine")
OWN = {"thrust": "kind = 'thrust'", "machine": "&shaft\n"}  # what templates have that are named after no analysis
BEARING = "bearing.nml"  # of the machine, whose first line says how it is made
SECONDS = 900
ROOT = pathlib.Path(__file__).resolve().parents[2]


def call(*words, folder, given="", ranks=1):
    """Status, output and error stream."""
    command = [GFB, *words] if ranks == 1 else [MPIEXEC, "-n", str(ranks), GFB, *words]
    done = subprocess.run(command, cwd=folder, input=given.encode(), capture_output=True, timeout=SECONDS, check=False)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def wanted(text, group):
    """A template with a group that it only offers."""
    inside = re.search(rf"^!&{group}$.*?^!/$", text, re.M | re.S)[0]
    if group == "sample":  # of random heights
        text = re.sub(r"^  ! height_deviation = ", "  height_deviation = 1.0e-6 ", text, flags=re.M)
    return text.replace(inside, "\n".join(line[1:] for line in inside.split("\n")))


def check_templates(checks, folder):
    """Every analysis has one; it runs as it is, without a warning, and with each group that it offers."""
    offered = []
    for analysis in ANALYSES:
        status, text, wrong = call("--template", analysis, folder=folder)
        checks.that(f"--template {analysis}", status == 0 and not wrong and
                    OWN.get(analysis, f"analysis = '{analysis}'") in text)
        if analysis == "machine":
            write_bearing(checks, folder, text)
        checks.that(f"{analysis}: lines that a screen has", max(map(len, text.splitlines())) <= 120)
        (folder/f"{analysis}.nml").write_text(text, encoding="utf-8")
        status, _, wrong = call("--strict", "--output", "there", f"{analysis}.nml", folder=folder)
        checks.that(f"{analysis}: runs unchanged {wrong}", status == 0 and (folder/f"there/{analysis}.h5").exists())
        for group in re.findall(r"^!&(\w+)$", text, re.M):
            offered.append(f"{analysis}_with_{group}.nml")
            (folder/offered[-1]).write_text(wanted(text, group), encoding="utf-8")
    first = (folder/offered[0]).read_text(encoding="utf-8")
    status, _, wrong = call("--check", "--strict", "-", folder=folder, given=first)
    checks.that(f"{offered[0]} from the standard input {wrong}", status == 0)
    status, told, wrong = call("--check", "--strict", "--groups", "1", *offered, folder=folder)
    checks.that(f"with each group {wrong}", status == 0)
    for name in offered:
        checks.that(f"{name}: in order", f"{name} is in order" in told)
    _, text, _ = call("--template=equilibrium", folder=folder)
    keys = {(group, key) for group, key in re.findall(r"^\| `&(\w+)` \| `(\w+)` ", call("--keys", folder=folder)[1], re.M)
            if group not in ("modes", "strip_load", "dynamics", "rotor", "capacity", "transient", "periodic", "unbalance",
                             "foil_damping", "ramp", "shaft", "discs", "bearings", "loads", "machine")}
    named, group = set(), ""
    for line in text.splitlines():
        group = (re.findall(r"^!?&(\w+)$", line) or [group])[0]
        named |= {(group, key) for key in re.findall(r"^!?  (?:! )?(\w+) = ?", line)}
    checks.that(f"equilibrium: all its keys are there {sorted(keys ^ named)}", named == keys)
    for word, expected in (("strp", "did you mean strip?"), ("nonsense", "no such analysis. The analyses are equilibrium")):
        status, words, wrong = call("--template", word, folder=folder)
        checks.that(f"--template {word}: {expected}", status == 1 and expected in wrong and not words)
    analyses = wrong.partition("The analyses are ")[2].strip().split(", ")
    helped = re.findall(r"\w+", call("--help", folder=folder)[1].partition("; A: ")[2].partition("--short")[0])
    checks.that(f"--help: all {len(analyses)} analyses of --template", len(analyses) > 5 and helped == analyses)


def write_bearing(checks, folder, text):
    """The bearing of the machine's template, by the command in its first line."""
    command, _, name = text.partition("\n")[0].partition(": ")[2].partition(" > ")
    status, bearing, wrong = call(*command.split()[1:], folder=folder)
    checks.that(f"{command}: the machine's bearing", status == 0 and not wrong and name == BEARING and f"'{name}'" in text)
    (folder/name).write_text(bearing, encoding="utf-8")


def check_short(checks, folder):
    """25 lines that run, of each analysis, and of each topic that has a template: with the groups that the topic is of."""
    topics = {line.split()[0] for line in call("--explain", "topics", folder=folder)[1].splitlines()}
    begun = {topic for topic in topics if "--short" in call("--explain", topic, folder=folder)[1]}
    checks.that(f"topics with a template: {len(begun)} of {len(topics)}", len(begun) > 20)
    run = {}
    write_bearing(checks, folder, call("--template", "machine", "--short", folder=folder)[1])
    for word in sorted(begun | set(ANALYSES)):
        status, text, wrong = call("--template", word, "--short", folder=folder)
        lines = text.splitlines()
        checks.that(f"--template {word} --short: {len(lines)} lines", status == 0 and not wrong and len(lines) <= 25 and max(map(len, lines)) <= 120)
        run.setdefault(text, word)
    for text, word in run.items():
        status, _, wrong = call("--strict", "--output", str(folder/"short"), "-", folder=folder, given=text)
        checks.that(f"{word}: runs {wrong}", status == 0)
    heated = call("--template", "cooling", "--short", folder=folder)[1]
    checks.that("cooling: with heat", "&thermal " in heated and "&sweep" not in heated)
    checks.that("--short alone: refused", "is of --template" in call("--short", folder=folder)[2])


def check_explanations(checks, folder):
    """--explain and help, of keys, groups and results."""
    for word, parts in {
            "bearing%clearance": ("key clearance of &bearing", "unit     m", "required"),
            "&gas": ("&gas has the keys", "viscosity [Pa s]"),
            "load": ("key load of &operation", "result load"),
            "frequency_3": ("natural frequency", "Hz"),
            "minimum_gap_error": ("unit     m", "&accuracy")}.items():
        status, told, wrong = call("--explain", word, folder=folder)
        checks.that(f"{word}: {parts}", status == 0 and not wrong and all(part in told for part in parts))
        checks.that(f"{word}: no mark of Markdown", "`" not in told)
    for line in call("--explain", "topics", folder=folder)[1].splitlines():
        page = re.search(r"^  manual   (docs/manual/\w+\.md)$", call("--explain", line.split()[0], folder=folder)[1], re.M)
        checks.that(f"{line.split()[0]}: its page of the manual", page and (ROOT/page[1]).exists())
    checks.that("help WORD is --explain WORD", call("help", "load", folder=folder)[1] == call(
        "--explain=load", folder=folder)[1])
    status, told, wrong = call("--explain", "clearence", folder=folder)
    checks.that("clearence: the nearest name", status == 1 and "did you mean clearance?" in wrong and not told)
    status, told, wrong = call("--explain", "torque", folder=folder)
    checks.that("torque: all whose meanings have it", status == 0 and not wrong and "result friction_torque: " in told and "topic  power_loss: " in told)
    checks.that("help is --help", call("help", folder=folder)[1] == call("--help", folder=folder)[1])
    checks.that("--explain alone", "needs a key" in call("--explain", folder=folder)[2])


def check_input(checks, folder):
    """`-` is the standard input, and what follows `--` is a file."""
    case = call("--template", "strip", folder=folder)[1]
    for ranks in (1, 2):
        place = folder/str(ranks)
        status, _, wrong = call("--output", str(place), "-", folder=folder, given=case, ranks=ranks)
        checks.that(f"gfb - on {ranks} rank(s) {wrong}", status == 0 and (place/"stdin.summary").exists())
    status, _, wrong = call("-", folder=folder, given=case.replace("&bump_foil", "&bumpfoil"))
    checks.that("its mistakes have a place", status == 1 and re.search(r"^stdin:\d+: unknown group '&bumpfoil'", wrong, re.M))
    for given, expected in (("", "is empty"), ("\0", "is binary"), ("! long\n"*200000, "more than the limit")):
        status, _, wrong = call("-", folder=folder, given=given)
        checks.that(f"gfb -: {expected}", status == 1 and expected in wrong)
    checks.that("--groups -: refused", "not the standard input" in call("--groups", "1", "-", folder=folder, given=case)[2])
    (folder/"-x.nml").write_text(case, encoding="utf-8")
    status, _, _ = call("--output", "dash", "--", "-x.nml", folder=folder)
    checks.that("gfb -- -x.nml", status == 0 and (folder/"dash/-x.summary").exists())


def main():
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    checks = Checks()
    for check in (check_templates, check_short) if "--long" in sys.argv[1:] else (check_explanations, check_input):
        with tempfile.TemporaryDirectory() as folder:
            check(checks, pathlib.Path(folder))
    checks.close()


if __name__ == "__main__":
    main()
