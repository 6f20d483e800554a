"""A population of bearings: how many have an answer, how many are refused by name, what either costs.

--set random: bearings drawn from a fixed seed, member by member, so that the first hundred of a thousand are the same.
--set engineer: one bearing, 12 directions of the load x 4 loads x 3 speeds, beams and shells.
--set hot: those bearings with heat, rigid ones too, of one pad or three, on the default mesh. --set tilted: those bearings, tilted.
Touch-downs and folds are shown a second way. A run is stopped at a bound on its CPU time, which counts as no answer.
Rows are kept in build/bench/population.json, so that an interrupted command goes on with --reuse. Beside the page is a table of
all members; with --earlier such a table, a refusal that it has, too, is not shown once more.
"""

import concurrent.futures
import hashlib
import json
import pathlib
import threading

from gfb.bench.population import page
from gfb.bench.population.members import FOUNDATION, MODELS, SEED, SETS
from gfb.bench.population.trial import BOUND, REFUSALS, second_way, shows_itself, try_case
from gfb.bench.runs import keep_rows, kept_rows
from gfb.build import version_of
from gfb.running import write_case
from gfb.tool import MEASURED, ROOT, stop

STORE = ROOT/"build/bench/population.json"
WORDS = {"foundation": FOUNDATION, **{model: model for model in MODELS}}


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--set", choices=SETS, default="random", help="which population; default: %(default)s")
    parser.add_argument("--count", metavar="N", type=int, default=1000, help="its first N members; default: %(default)s")
    parser.add_argument("--seed", metavar="N", type=int, default=SEED, help="another one draws other members; default: %(default)s")
    parser.add_argument("--models", metavar="LIST", default="rigid,foundation,beam,shell",
                        help="of %(default)s; members have those that the set draws, in turn")
    parser.add_argument("--jobs", metavar="N", type=int, default=2, help="runs at a time; default: %(default)s")
    parser.add_argument("--seconds", metavar="S", type=float, default=300.0,
                        help="CPU time of a run at most; default: %(default)s")
    parser.add_argument("--reuse", action="store_true", help="go on with the runs of an earlier call")
    parser.add_argument("--earlier", metavar="FILE", type=pathlib.Path,
                        help="a table of an earlier program, such as docs/measured/population.csv: second ways of members that end "
                             "as they did there are taken from it")
    parser.add_argument("--kept", action="store_true", help="run nothing: the page of the runs that are kept")
    parser.add_argument("--only-write", metavar="DIR", type=pathlib.Path, help="write the case files there, run nothing")
    parser.add_argument("--docs", action="store_true", help="write the page to docs/measured")


def run(options):
    """Runs the members; returns the table and leaves the page."""
    models = [WORDS.get(word) for word in options.models.split(",")]
    if None in models:
        stop(f"--models {options.models}: {', '.join(WORDS)}")
    if options.count < 1 or options.jobs < 1 or options.seconds <= 0.0:
        stop("--count, --jobs and --seconds: more than 0")
    members = SETS[options.set](options.count, models, options.seed)
    if options.docs and options.seed != SEED:
        stop(f"--seed {options.seed}: the page of docs/measured is of seed {SEED}")
    if options.only_write:
        options.only_write.mkdir(parents=True, exist_ok=True)
        for member in members:
            write_case(options.only_write, file_name(member), member.groups)
        return f"{len(members)} case files are in {options.only_write}\n"
    if options.kept:
        rows = kept_rows(STORE, program_of(options))
        members = [member for member in members if key_of(member) in rows]
        rows = [rows[key_of(member)] for member in members]
        if not rows:
            stop(f"{STORE} has no runs of this program")
    else:
        rows = measure(members, options)
    return page.write(members, rows, options, MEASURED if options.docs else options.output)


def file_name(member):
    """A member's name as a file has it."""
    return f"{member.model}_{member.name}".replace(", ", "_").replace(" ", "")


def key_of(member):
    """What a row is kept under."""
    text = json.dumps(member.groups, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def program_of(options):
    """What the runs of a program are kept under."""
    return hashlib.sha256(pathlib.Path(options.gfb).read_bytes()).hexdigest()[:16]


def measure(members, options):
    """A row a member; those that are kept are not run again."""
    program = program_of(options)
    rows = kept_rows(STORE, program) if options.reuse else {}
    earlier = page.read_ways(options.earlier) if options.earlier else {}
    version = version_of(options.gfb).partition(",")[0].removeprefix("gfb ")  # and commit
    lock = threading.Lock()

    def keep(member, row):
        with lock:
            rows[key_of(member)] = row
            keep_rows(STORE, program, rows)
        print(f"{member.model} {member.name}: {row['outcome']}{', ' + row['shown'] if row['shown'] else ''}, "
              f"{row['cpu']:.1f} s, {row['summary'].get('factorizations', 0):.0f} factorizations", flush=True)

    def end(member):
        kept = rows.get(key_of(member))
        if not kept or kept["outcome"] == BOUND and kept["bound"] < options.seconds:
            keep(member, {**try_case(options.gfb, member.groups, options.seconds), "bound": options.seconds, "shown": ""})

    def known(member, row):
        return earlier.get((member.name, member.model, row["outcome"]))

    def show(member):
        row = rows[key_of(member)]
        if row["outcome"] in REFUSALS and not row["shown"]:
            if known(member, row):
                (shown, by), spent = known(member, row), 0.0
            else:
                (shown, spent), by = second_way(options.gfb, member, row), version
            keep(member, {**row, "shown": shown, "shown_by": by, "cpu_shown": spent})

    def work_on(work, some):
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for done in [pool.submit(work, member) for member in some]:
                done.result()

    def cost(member):
        row = rows[key_of(member)]
        return 0.0 if shows_itself(member, row) or known(member, row) else row["cpu"]

    work_on(end, members)  # all ends first, then what costs least: a command that is interrupted has most of them
    work_on(show, sorted(members, key=cost))
    return [rows[key_of(member)] for member in members]
