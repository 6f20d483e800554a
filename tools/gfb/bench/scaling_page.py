"""Tables, pictures and the page of tools/bench scaling."""

import math
import os

import numpy

from gfb.bench.runs import PARTS, PHASES, part
from gfb.tables import markdown_table, plain_table

SETTLED = 2.5e4  # unknowns from which on growth is fitted; below, the program's own start shows
FLAT_FROM = 9.0e4  # unknowns from which on memory over unknowns is compared
AIM_RATIO, AIM_EXPONENT, AIM_FLAT = 1.8, 1.3, 1.2
AIM_STRIP, AIM_MEMORY = 1.0e6, 4.0*2.0**30  # unknowns; bytes
NAMES = {"strip frictionless full": "strip, full order, no friction", "strip full": "strip, full order, friction",
         "strip reduced": "strip, reduced, friction", "strip longer": "strip, reduced, no friction, more bumps",
         "bearing full": "bearing, full order", "bearing reduced": "bearing, reduced"}
REDUCED = ("strip reduced", "strip longer", "bearing reduced")
# A common cluster, for the model on paper.
LATENCY, NODE_BANDWIDTH, NODE_RANKS = 2.0e-6, 12.5e9, 64  # [s], [B/s], ranks that share it
MODEL_RANKS = (64, 256, 1000)
UP_TO = 4.0e6  # bytes of a number that are shown in kB


def fit(sizes, values):
    """Exponent of a power law through points; not a number with fewer than two."""
    if len(sizes) < 2:
        return math.nan
    return float(numpy.polyfit(numpy.log(sizes), numpy.log(values), 1)[0])


def done(rows):
    """Rows that have a result."""
    return [row for row in rows if not row["stopped"]]


def settled(rows):
    """Rows from which exponents are taken: the larger ones, all of a few."""
    large = [row for row in done(rows) if row["full_unknowns"] >= SETTLED]
    return large if len(large) > 1 else done(rows)


# --- growth ---

def growth_table(growth):
    """Title, heads and rows."""
    lines = []
    for name, rows in growth.items():
        for i, row in enumerate(rows):
            head = [NAMES[name] if i == 0 else "", row["mesh"]]
            if row["stopped"]:
                lines.append([*head, f"about {row['target']:,.0f}", "stopped"] + [""]*9)
                continue
            summary, whole = row["summary"], row["cpu"]
            lines.append([*head, f"{row['full_unknowns']:,.0f}", f"{summary['unknowns']:,.0f}",
                          f"{summary['newton_iterations']:.0f}", f"{summary['factorizations']:.0f}", f"{whole:.2f}",
                          share(part(row, "factorization"), whole), share(part(row, "solve"), whole),
                          share(part(row, "assembly"), whole), share(part(row, "condensation"), whole),
                          f"{row['memory']/2**20:,.0f}", f"{row['memory']/row['full_unknowns']/1e3:.2f}"])
    heads = ["model", "mesh", "unknowns, full order", "unknowns solved", "Newton iterations", "factorizations",
             "CPU [s]", "factorization", "solves", "assembly", "condensation", "memory [MiB]", "kB an unknown"]
    return ("mesh: elements of an arc + a flat x width, or bumps; shares are of the CPU time; one rank", heads, lines)


def share(one, whole):
    """As a percentage."""
    return f"{100.0*one/whole:.0f} %" if whole > 0.0 else ""


def exponents(rows):
    """Exponents of CPU time, CPU time of a factorization, condensation, memory over unknowns of full order."""
    used = settled(rows)
    sizes = [row["full_unknowns"] for row in used]
    return {"cpu": fit(sizes, [row["cpu"] for row in used]),
            "iteration": fit(sizes, [row["cpu"]/max(1.0, row["summary"]["newton_iterations"]) for row in used]),
            "factorization": fit(sizes, [max(part(row, "factorization"), 1e-6)
                                         / max(1.0, row["summary"]["factorizations"]) for row in used]),
            "memory": fit(sizes, [row["memory"] for row in used]), "rows": len(used)}


def flatness(rows):
    """Largest over smallest memory an unknown of the large meshes; None with fewer than two."""
    each = [row["memory"]/row["full_unknowns"] for row in done(rows) if row["full_unknowns"] >= FLAT_FROM]
    return max(each)/min(each) if len(each) > 1 else None


def exponent_table(growth):
    """Title, heads and rows."""
    lines = []
    for name, rows in growth.items():
        if not done(rows):
            lines.append([NAMES[name], "none"] + [""]*5 + [rows[-1]["stopped"]])
            continue
        found, flat = exponents(rows), flatness(rows)
        lines.append([NAMES[name], f"{found['rows']}, to {done(rows)[-1]['full_unknowns']:,.0f}",
                      *(two(found[one]) for one in ("cpu", "iteration", "factorization", "memory")),
                      "" if flat is None else f"{flat:.2f}", rows[-1]["stopped"] or "the largest asked for"])
    heads = ["model", "levels fitted, largest", "CPU", "CPU an iteration", "a factorization", "memory",
             "memory an unknown, largest / smallest", "what stopped it"]
    return ("exponents of the growth with the unknowns of full order", heads, lines)


def two(value):
    """With two decimals, where it is a number."""
    return "" if math.isnan(value) else f"{value:.2f}"




# --- ranks ---

def smallest(rows, name):
    """Of a part over the repetitions [s]."""
    return min(part(row, name) for row in rows)


def rank_ratios(measured):
    """{words: {part: (one rank, two ranks)}} of what has a result on both."""
    ratios = {}
    for words, by_ranks in measured.items():
        one, other = done(by_ranks[1]), done(by_ranks[2])
        if one and other:
            ratios[words] = {name: (smallest(one, name), smallest(other, name)) for name in PARTS}
            ratios[words]["whole"] = (min(row["cpu"] for row in one), min(row["cpu"] for row in other))
    return ratios


def rank_table(measured):
    """Title, heads and rows."""
    lines = []
    for words, parts in rank_ratios(measured).items():
        for i, (name, (one, other)) in enumerate(parts.items()):
            tells = max(one, other) > 0.02
            lines.append([words if i == 0 else "", name, f"{one:.3f}", f"{other:.3f}",
                          f"{one/other:.2f}" if tells and other > 0.0 else ""])
    for words, by_ranks in measured.items():
        stopped = [row["stopped"] for rows in by_ranks.values() for row in rows if row["stopped"]]
        if stopped:
            lines.append([words, stopped[0], "", "", ""])
    heads = ["case", "part", "1 rank [s]", "2 ranks [s]", "ratio"]
    return ("CPU time, largest of the ranks, smallest of the repetitions; no ratio below 20 ms", heads, lines)



# --- messages ---

def counts(row):
    """Of one Newton iteration: the largest over ranks of messages, bytes, collectives; all bytes of all ranks."""
    iterations = max(1.0, row["summary"]["newton_iterations"])
    of_ranks = []
    for petsc, mumps in zip(row["messages"], row["mumps"]):
        solving = [mumps[phase] for phase in PHASES if phase in ("factorization", "solve")]
        of_ranks.append({name: petsc[name] + sum(one[name] for one in solving) for name in petsc})
    largest = {name: max(one[name] for one in of_ranks)/iterations for name in of_ranks[0]}
    return {**largest, "all messages": sum(one["messages"] for one in of_ranks)/iterations,
            "all bytes": sum(one["bytes"] for one in of_ranks)/iterations,
            "by MUMPS": sum(mumps[phase]["bytes"] for mumps in row["mumps"] for phase in ("factorization", "solve"))
            / max(1.0, sum(one["bytes"] for one in of_ranks))}


def message_table(measured):
    """Title, heads and rows."""
    lines = []
    for words, rows in measured.items():
        for i, row in enumerate(rows):
            head = [words if i == 0 else "", f"{row['ranks']}"]
            if row["stopped"]:
                lines.append([*head, row["stopped"]] + [""]*6)
                continue
            one = counts(row)
            lines.append([*head, f"{row['summary']['newton_iterations']:.0f}", f"{one['messages']:,.0f}",
                          bytes_text(one["bytes"]), f"{one['collectives']:,.0f}", f"{one['all messages']:,.0f}",
                          bytes_text(one["all bytes"]), share(one["by MUMPS"], 1.0)])
    heads = ["case", "ranks", "Newton iterations", "messages a rank", "bytes a rank", "collectives", "messages, all",
             "bytes, all", "bytes by MUMPS"]
    return ("sent in a Newton iteration; a rank: the one that sends most", heads, lines)


def bytes_text(value):
    """In kB or MB."""
    return f"{value/1e3:,.0f} kB" if value < UP_TO else f"{value/1e6:,.1f} MB"


def message_exponents(rows):
    """Exponents of the counts over the last two numbers of ranks, and the last counts."""
    used = [row for row in done(rows) if row["ranks"] > 1][-2:]
    if len(used) < 2:
        return None
    ranks, found = [row["ranks"] for row in used], [counts(row) for row in used]
    return {name: (fit(ranks, [max(one[name], 1.0) for one in found]), found[-1][name])
            for name in ("messages", "bytes", "collectives", "all bytes")} | {"from": ranks[0], "ranks": ranks[1]}



def model_rows(measured, growth):
    """The model on paper: rows of (words, ranks, computing, latency, bytes, collectives) [s] of a Newton iteration."""
    lines = []
    for words, rows in measured.items():
        one, base = message_exponents(rows), done(rows)
        if one is None or base[0]["ranks"] != 1:
            continue
        kind = "strip longer" if "no friction" in words else "strip reduced"
        if "bearing" in words:
            kind = "bearing " + ("full" if "full order" in words else "reduced")
        large = done(growth.get(kind, []))
        target = large[-1] if large else base[0]
        iteration = solving(target)/max(1.0, target["summary"]["newton_iterations"])
        bigger = target["summary"]["unknowns"]/base[0]["summary"]["unknowns"]
        for ranks in MODEL_RANKS:
            now = {name: one[name][1]*(ranks/one["ranks"])**one[name][0] for name in ("messages", "collectives",
                                                                                     "all bytes")}
            mean, beyond = now["all bytes"]/ranks, one["bytes"][1] - one["all bytes"][1]/one["ranks"]
            lines.append((f"{words.rsplit(', ', 1)[0]}, {target['summary']['unknowns']:,.0f} unknowns", ranks,
                          iteration/ranks, LATENCY*now["messages"],
                          bigger*max(mean*NODE_RANKS, mean + beyond)/NODE_BANDWIDTH,
                          2.0*LATENCY*math.log2(ranks)*now["collectives"], iteration))
    return lines


def solving(row):
    """CPU time of a run's Newton iterations on one rank [s]."""
    return sum(part(row, name) for name in ("assembly", "factorization", "solve", "rest"))


def model_table(lines):
    """Title, heads and rows."""
    cells = []
    for i, (words, ranks, computing, latency, sent, collectives, iteration) in enumerate(lines):
        whole = computing + latency + sent + collectives
        cells.append([words if i == 0 or lines[i - 1][0] != words else "", f"{ranks}",
                      *(f"{1e3*one:.2f}" for one in (computing, latency, sent, collectives, whole)),
                      share(iteration/ranks, whole)])
    heads = ["case", "ranks", "computing [ms]", "messages [ms]", "bytes [ms]", "collectives [ms]", "iteration [ms]",
             "efficiency"]
    return ("model of a Newton iteration; nothing here is timed on more than one rank", heads, cells)



# --- aims ---

def aim_table(measured):
    """Title, heads and rows."""
    lines = []
    ratios = rank_ratios(measured.get("ranks", {}))
    varied = next((parts for words, parts in ratios.items() if words.startswith("condensed strip")), None)
    for name in ("condensation", "assembly"):
        if varied:
            one, other = varied[name]
            lines.append(verdict(f"{name} on 2 ranks, no two bumps equal", f"at least {AIM_RATIO}",
                                 f"{one/other:.2f}", one/other >= AIM_RATIO))
    growth = measured.get("growth", {})
    for name in REDUCED:
        if len(done(growth.get(name, []))) > 1:
            value = exponents(growth[name])["cpu"]
            lines.append(verdict(f"exponent of the CPU time, {NAMES[name]}", f"at most {AIM_EXPONENT}",
                                 f"{value:.2f}", value <= AIM_EXPONENT))
    for name, rows in growth.items():
        flat = flatness(rows)
        if flat is not None:
            lines.append(verdict(f"memory an unknown from {FLAT_FROM:,.0f} unknowns on, {NAMES[name]}",
                                 f"within {100*(AIM_FLAT - 1):.0f} %", f"{100*(flat - 1):.0f} %", flat <= AIM_FLAT))
    rows = growth.get("strip frictionless full", [])
    large = [row for row in done(rows) if row["full_unknowns"] >= AIM_STRIP]
    if large:
        lines.append(verdict(f"{NAMES['strip frictionless full']}, {large[0]['full_unknowns']:,.0f} unknowns",
                             "under 4 GiB", f"{large[0]['memory']/2**30:.2f} GiB", large[0]["memory"] < AIM_MEMORY))
    elif len(done(rows)) > 1:
        last = done(rows)[-1]
        guess = last["memory"]*(AIM_STRIP/last["full_unknowns"])**exponents(rows)["memory"]
        lines.append([f"{NAMES['strip frictionless full']}, 1e6 unknowns", "under 4 GiB",
                      f"about {guess/2**30:.2f} GiB", "not measured: by the growth so far"])
    return ("aims", ["aim", "asked for", "measured", "reached"], lines)


def verdict(words, asked, measured, reached):
    """A row of the aims."""
    return [words, asked, measured, "yes" if reached else "**no**"]


# --- the page ---

def write(measured, options, folder):
    """Leaves page, tables and pictures; returns the tables as plain text."""
    folder.mkdir(parents=True, exist_ok=True)
    tables, pieces = [], [page_head(measured, options)]

    def show(table):
        tables.append(table)
        return markdown_table(*table)

    pieces.append("## Aims\n\n" + show(aim_table(measured)))
    if "growth" in measured:
        draw_growth(measured["growth"], folder/"scaling_growth.png")
        pieces.append(GROWTH + show(growth_table(measured["growth"])) + "\n" + EXPONENTS
                      + show(exponent_table(measured["growth"])))
    if "ranks" in measured:
        draw_ranks(measured["ranks"], folder/"scaling_ranks.png")
        pieces.append(TWO_RANKS.format(repetitions=options.repetitions) + show(rank_table(measured["ranks"])))
    if "messages" in measured:
        draw_messages(measured["messages"], folder/"scaling_messages.png")
        model = model_rows(measured["messages"], measured.get("growth", {}))
        pieces.append(MESSAGES + show(message_table(measured["messages"])) + "\n" + MODEL.format(latency=1e6*LATENCY, bandwidth=NODE_BANDWIDTH/1e9, ranks=NODE_RANKS)
                      + show(model_table(model)))
    missing = [name for name in ("growth", "ranks", "messages") if name not in measured]
    if missing:
        pieces.append("Not measured here: " + ", ".join(missing) + ".\n")
    (folder/"scaling.md").write_text("\n".join(pieces), encoding="utf-8")
    return f"page and pictures are in {folder}\n" + "".join("\n" + plain_table(*table) for table in tables)


def page_head(measured, options):
    """What was measured and how."""
    quick = "\n**These are the figures of `--quick`: small meshes, which say little.**\n" if options.quick else ""
    return f"""# What scales, and what does not

```
tools/bench scaling --docs           # hours, most of the machine's memory; --reuse resumes it where it was stopped
tools/bench scaling --quick          # minutes
```
{quick}
The tables are written by the tool from the figures of one machine: {os.cpu_count()} cores,
{os.sysconf("SC_PHYS_PAGES")*os.sysconf("SC_PAGE_SIZE")/2**30:.0f} GiB, shared with other jobs; a process was allowed \
{options.seconds:,.0f} s of CPU time, a run {options.memory/2**30:.0f} GiB.

All times are CPU times of each process, by PETSc's log (`-log_view`), whose clock the tool replaces; waiting for another
rank is not counted, and other jobs do not show as they would in times by the wall. With several ranks a part's time is
that of the rank that needs most. Parts do not overlap:

- `set-up`: meshes, their partition, contacts; `condensation`: super-elements.
- `assembly`: stiffness of the foils, then residuals and matrices of all Newton iterations.
- `factorization`: of the matrices of Newton's method, analysis included; `solve`: triangular solves, with the
  iterations of GMRES where factors of an earlier matrix are used.
- `output`: interior displacements, stresses and all files. `rest`: start, line searches, log.
"""


GROWTH = """## Growth

Strips of ten bumps of [Gu2020] table 1, case 1, under 0.2 MPa in two steps with friction 0.1 (one step without
friction, where the matrix is symmetric and positive), and the bearing of section 4.2 under 100 N from a cold start;
half the width is solved. A level has about three times the unknowns of the one before, by shorter elements in both directions
or, with `more bumps`, by more of 12 + 3 x 48 elements; these have no friction, because slip travels from bump to bump
and needs more Newton iterations the more bumps there are, whatever a solver does. `unknowns, full order`: of the same
mesh without condensation; those of film and shaft, some 7 %, are in a bearing's.

![CPU time, memory and share of factorization against unknowns](scaling_growth.png)

"""
EXPONENTS = """Exponents, fitted to levels of 25,000 unknowns and more:

"""
TWO_RANKS = """## One and two ranks

The condensed strip has bumps that grow along it, so that each of its super-elements is condensed on its own; equal
bumps would cost three condensations on any number of ranks. It is factored twice and solved once for one load. Runs of
each: {repetitions}, in turn on one rank and on two; the smallest time of a part counts.

![CPU time on one rank and on two, largest of the ranks](scaling_ranks.png)

"""
MESSAGES = """## Messages

Counted, not timed: the ranks share the cores of one machine. PETSc counts its own messages (`-log_view`), a probe
those of MUMPS in factorizations and solves; what the factorization of a large last front sends through ScaLAPACK is not
counted. `collectives`: calls that all ranks take part in. On more than 16 ranks right sides go through the first rank:
MUMPS would take a collective call for every rank in each solve ([cluster.md](../manual/cluster.md)).

![Messages and bytes of a Newton iteration against ranks](scaling_messages.png)

"""
MODEL = """### A thousand ranks on paper

Assumed: {latency:g} us for a message, {bandwidth:g} GB/s of a node shared by {ranks} ranks, a collective call in
2 log2(ranks) messages. Computing is the CPU time of a Newton iteration of the largest mesh measured on one rank, shared
out evenly: better than any partition. The counts above are continued by the power laws of the last two numbers of ranks,
bytes in proportion to the unknowns; what the busiest rank sends beyond the mean stays as it is. Nothing overlaps.

"""


# --- pictures ---

def pyplot_of():
    """Matplotlib without a screen."""
    from matplotlib import pyplot
    return pyplot


def draw_growth(growth, path):
    """CPU time, memory, share of factorization against unknowns."""
    figure, (time, memory, shares) = pyplot_of().subplots(1, 3, figsize=(13.0, 4.4), layout="constrained")
    for colour, (name, rows) in enumerate(growth.items()):
        rows = done(rows)
        sizes = [row["full_unknowns"] for row in rows]
        style = {"color": f"C{colour}", "marker": "o", "markersize": 4, "label": NAMES[name],
                 "linestyle": "-" if name in REDUCED else "--"}
        time.plot(sizes, [row["cpu"] for row in rows], **style)
        memory.plot(sizes, [row["memory"]/row["full_unknowns"]/1e3 for row in rows], **style)
        shares.plot(sizes, [100.0*part(row, "factorization")/row["cpu"] for row in rows], **style)
    time.set(xscale="log", yscale="log", ylabel="CPU time [s]", title="one rank, whole run")
    memory.set(xscale="log", ylabel="peak memory over unknowns [kB]", title="memory")
    memory.set_ylim(bottom=0.0)
    shares.set(xscale="log", ylabel="share of factorization [%]", ylim=(0, 100), title="factorization")
    for axes in (time, memory, shares):
        axes.set_xlabel("unknowns, full order")
        axes.grid(alpha=0.3)
    time.legend(fontsize=7)
    figure.savefig(path, dpi=90)


def draw_ranks(measured, path):
    """Parts on one rank and two, over the whole on one."""
    figure, axes = pyplot_of().subplots(figsize=(10.5, 4.2), layout="constrained")
    place, places, words = 0.0, [], []
    for name, parts in rank_ratios(measured).items():
        whole = sum(parts[one][0] for one in PARTS)
        for ranks in (0, 1):
            bottom = 0.0
            for colour, one in enumerate(PARTS):
                height = parts[one][ranks]/whole
                axes.bar(place, height, bottom=bottom, color=f"C{colour}", label=one if place == 0.0 else None)
                bottom += height
            places.append(place)
            words.append(f"{ranks + 1} rank" + "s"*ranks)
            place += 1.0
        axes.annotate(name.replace(", ", "\n"), (place - 1.5, 1.08), ha="center", va="bottom", fontsize=8)
        place += 0.7
    axes.set_xticks(places, words, fontsize=8)
    axes.set(ylabel="CPU time over that on one rank", ylim=(0.0, 1.35), title="parts: largest of the ranks")
    axes.grid(axis="y", alpha=0.3)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(path, dpi=90)


def draw_messages(measured, path):
    """Messages and bytes of the rank that sends most, and of all."""
    figure, panels = pyplot_of().subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    for colour, (words, rows) in enumerate(measured.items()):
        rows = [row for row in done(rows) if row["ranks"] > 1]
        found = [counts(row) for row in rows]
        ranks = [row["ranks"] for row in rows]
        for axes, one, everything in zip(panels, ("messages", "bytes"), ("all messages", "all bytes")):
            style = {"color": f"C{colour}", "marker": "o", "markersize": 4}
            axes.plot(ranks, [count[one] for count in found], label=words, **style)
            axes.plot(ranks, [count[everything] for count in found], linestyle=":", **style)
    for axes, what in zip(panels, ("messages", "bytes")):
        axes.set(xscale="log", yscale="log", xlabel="ranks", ylabel=f"{what} a Newton iteration",
                 title=f"{what}: the busiest rank, all (dotted)")
        ranks = sorted({row["ranks"] for rows in measured.values() for row in done(rows) if row["ranks"] > 1})
        axes.set_xticks(ranks, [str(one) for one in ranks])
        axes.minorticks_off()
        axes.grid(alpha=0.3)
    panels[0].legend(fontsize=7)
    figure.savefig(path, dpi=90)
