"""The keys of a case file as the manual has them: of `gfb --keys`, one table a group, narrow enough for a page of paper."""

from gfb.program import table_rows
from gfb.tool import stop

MOST = 12  # letters of a default with blanks that still has the narrow column
PURPOSES = {  # what a group is for, and where more of it stands
    "scene": "What is computed.",
    "shaft": "A shaft that bends: with it the case is a machine ([machine.md](machine.md)).",
    "discs": "Rigid discs on that shaft.",
    "bearings": "The bearings of a machine, a case file each ([machine.md](machine.md#the-case)).",
    "loads": "Forces and moments on the shaft of a machine.",
    "machine": "Speed, weight and places of a machine.",
    "modes": "Natural modes of a strip or of its parts ([strip.md](strip.md)).",
    "bearing": "Size and clearance of the bearing.",
    "model": "How foils and film are modelled ([model_and_mesh.md](model_and_mesh.md)).",
    "pads": "Several pads, and their preload ([pads.md](pads.md)).",
    "ramp": "Ramps of the pads of a thrust bearing ([thrust.md](thrust.md)).",
    "bore": "A bore that is no circle: waves, shims, a measured profile ([gas_and_bore.md](gas_and_bore.md)).",
    "gas": "The gas, its laws and its flow ([gas_and_bore.md](gas_and_bore.md)).",
    "shaft_contact": "Asperities that carry where the film is thin ([capacity.md](capacity.md)).",
    "operation": "Speed, and the load or the position of the shaft ([frame.md](frame.md)).",
    "dynamics": "Rotordynamic coefficients ([coefficients.md](coefficients.md)).",
    "rotor": "The rotor on the bearing, its modes and threshold speed ([stability.md](stability.md#rotor-modes-and-the-threshold-speed)).",
    "transient": "Transient analysis ([transient.md](transient.md)).",
    "periodic": "Periodic solutions ([periodic.md](periodic.md)).",
    "unbalance": "What drives the shaft once a turn ([transient.md](transient.md)).",
    "foil_damping": "Structural damping and mass of the foils ([foil_damping.md](foil_damping.md#what-each-foil-model-does-under-vibration)).",
    "capacity": "Limits of load, speed and tilt, and the film that is wanted in any case ([capacity.md](capacity.md)).",
    "sweep": "Several values of a key, one after the other ([sweeps.md](sweeps.md)).",
    "top_foil": "The foil under the film.",
    "bump_foil": "The bumps under the top foil, as drawn and as built ([strips_as_built.md](strips_as_built.md)).",
    "feed": "Gas that is fed into the film under pressure ([feed.md](feed.md)).",
    "grooves": "Grooves on the shaft or the sleeve that pump gas ([grooves.md](grooves.md)).",
    "thermal": "Heat of gas, foils, shaft and sleeve ([heat.md](heat.md)).",
    "strip_load": "What loads a strip ([strip.md](strip.md)).",
    "contact": "Contact and friction of the foils ([strip.md](strip.md)).",
    "mesh": "Elements of film and foils ([bearing_mesh.md](../measured/bearing_mesh.md)).",
    "solver": "Tolerances and limits of the search ([method.md](method.md)).",
    "output": "What is written beside the summary ([results.md](results.md)).",
    "sensitivity": "How results follow the keys ([sensitivity.md](sensitivity.md)).",
    "accuracy": "An answer with a stated error ([accuracy.md](accuracy.md)).",
    "sample": "Statistics over bearings as they are built ([sample.md](sample.md)).",
}


def key_tables(printed):
    """The manual's sections, in the program's order of groups."""
    groups: dict[str, list[list[str]]] = {}
    for group, *row in table_rows(printed):
        groups.setdefault(group.strip("`&"), []).append(row)
    unknown = sorted(groups.keys() ^ PURPOSES.keys())
    if unknown:
        stop(f"what &{unknown[0]} is for stands in tools/gfb/key_tables.py: once for each group that gfb --keys has")
    index = "Groups: " + ", ".join(f"[&{name}](#{name})" for name in groups) + "\n"
    return index + "".join(section(name, rows) for name, rows in groups.items())


def section(name, rows):
    """A group: its head, its purpose, its table."""
    lines = ["", f"## &{name}", "", PURPOSES[name], "", "| key | value | default | meaning |", "| --- | --- | --- | --- |"]
    return "\n".join(lines + [f"| {' | '.join(narrow(*row))} |" for row in rows]) + "\n"


def narrow(key, kind, unit, default, meaning):
    """A row whose words to choose from, and a default that is a sentence, stand in the meaning."""
    head, quote, words = kind.partition("`")
    if words:
        several = head.startswith("list")
        meaning += f". {'Of' if several else 'One of'}: {quote}{words}"
        kind = "words" if several else "word"
    elif unit:
        kind = {"real": unit, "list of reals": f"list, {unit}"}.get(kind, f"{kind}, {unit}" if unit != "1" else kind)
    if " " in default and len(default) > MOST:
        said = default.startswith("required ")
        meaning += f". {'R' + default[1:] if said else f'Default: {default}'}"
        default = "if needed" if said else "depends"
    return key, kind, default, meaning
