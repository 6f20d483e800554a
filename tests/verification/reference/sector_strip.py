#!/usr/bin/env python3
"""Bump strips of a thrust bearing's sector and of a journal as solids of 20-node bricks; writes sector_strip.json.

    sector_strip.py [--ccx PROGRAM] [--quick]

Needs numpy, and CalculiX's solver `ccx` (Debian: calculix-ccx); takes about ten minutes on one core. Nothing here is
the program's. `--quick` leaves out the finest mesh and writes nothing.

The strip is developed: at each radius r its section is a curve in the plane of x = r theta and v, that of the mean
radius r_m with x stretched by r/r_m. The sheet lies between the curves at t/2 on both sides of it. Where an arc meets a
flat, each layer of nodes bends where its own two parallel curves cross (a mitre): both sides have their whole thickness
up to the kink.
"""

import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import tempfile

import numpy

MILLI = 1.0e-3  # CalculiX is given mm, N and MPa, in which its printed digits suit
SHEET = {"thickness": 1.0e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
STRIP = {"inner_radius": 0.025, "outer_radius": 0.05, "bumps": 2, "half_length": 1.5e-3, "height": 5.0e-4,
         "pitch": 4.0e-3} | SHEET
PLATE = {"inner_radius": 0.025, "outer_radius": 0.05, "length": 8.0e-3} | SHEET
DOWN, FORWARD = (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)  # directions of loads: (r, theta, v)
PRESS = [("crest_1", DOWN, 1000.0), ("crest_2", DOWN, 1000.0)]  # line forces [N/m]
THIN = [(name, way, 125.0) for name, way, _ in PRESS]  # half as thick bends eight times as much
RUB = [("crest_1", FORWARD, 1000.0)]
TIP = [("end", DOWN, 10.0)]
MESHES = [{"arc": 12, "flat": 4, "across": 16, "layers": 2}, {"arc": 24, "flat": 8, "across": 32, "layers": 2},
          {"arc": 48, "flat": 16, "across": 32, "layers": 2}]  # the last has 8192 bricks
NARROW = {"arc": 48, "flat": 16, "across": 2, "layers": 4}  # for plane strain
GRADE = 0.8  # elements at kinks, crests and edges are a fifth of even ones: stresses are steep there
DIGITS = 6.0e-7  # CalculiX prints seven
PLACES, WAYS = ("inner", "mean", "outer"), ("r", "theta", "v")


def axis(count, ends):
    """2 count + 1 places in [-1, 1]; towards -1 and 1 they are dense for ends near 1."""
    s = numpy.linspace(-1.0, 1.0, 2*count + 1)
    return (1.0 - ends)*s + ends*numpy.sin(0.5*numpy.pi*s)


class Sheet:
    """Nodes and bricks. A place is (i, j, k): along, across and through the sheet, in half elements."""

    def __init__(self, given, mesh, sector):
        self.given, self.sector = given, sector
        mean = 0.5*(given["inner_radius"] + given["outer_radius"])
        self.radius = mean + 0.5*(given["outer_radius"] - given["inner_radius"])*axis(mesh["across"], 0.8)
        self.stretch = (self.radius/mean if sector else numpy.ones_like(self.radius))[:, None]
        self.zeta = (0.5*given["thickness"]*numpy.linspace(-1.0, 1.0, 2*mesh["layers"] + 1))[None, :]
        self.sections = {"clamp": 0}
        curve = self.plate(mesh) if "length" in given else self.bumps(mesh)
        self.points = numpy.empty((len(curve), *curve[0][0].shape, 3))
        for i, (x, v) in enumerate(curve):
            radius = numpy.broadcast_to(self.radius[:, None], x.shape)
            angle = x/radius
            place = [radius*numpy.cos(angle), radius*numpy.sin(angle), v] if sector else [radius, x, v]
            self.points[i] = numpy.stack(place, -1)
        odd = sum(numpy.indices(self.points.shape[:3]) % 2)
        self.number = numpy.where(odd <= 1, numpy.cumsum(odd <= 1).reshape(odd.shape), 0)

    def plate(self, mesh):
        """(x, v) of each column of a flat strip."""
        columns = [(self.stretch*self.given["length"]*s + 0.0*self.zeta, self.zeta + 0.0*self.stretch)
                   for s in 0.5 + 0.5*axis(2*mesh["arc"], GRADE)]
        self.sections["end"] = len(columns) - 1
        return columns

    def bumps(self, mesh):
        """(x, v) of each column of a strip of arcs and flats."""
        height, half, pitch = (self.given[key] for key in ("height", "half_length", "pitch"))
        bend = (half**2 + height**2)/(2.0*height)
        foot = numpy.full(numpy.broadcast(self.stretch, self.zeta).shape, numpy.arcsin(half/bend))
        upright = foot.copy()
        for _ in range(50):  # Newton's method: where a curve parallel to the arc is as high as that of the flat
            length = numpy.hypot(self.stretch*numpy.cos(foot), numpy.sin(foot))
            excess = height - bend + bend*numpy.cos(foot) + self.zeta*(self.stretch*numpy.cos(foot)/length - 1.0)
            foot += excess/(numpy.sin(foot)*(bend + self.zeta*self.stretch/length**3))

        def arc(angle, bump):
            length = numpy.hypot(self.stretch*numpy.cos(angle), numpy.sin(angle))
            return (self.stretch*(half + bump*pitch + bend*numpy.sin(angle)) + self.zeta*numpy.sin(angle)/length,
                    height - bend + bend*numpy.cos(angle) + self.zeta*self.stretch*numpy.cos(angle)/length)

        half_arc, flat = (0.5 + 0.5*axis(count, GRADE)[1:] for count in (mesh["arc"]//2, mesh["flat"]))
        columns = [arc(-upright, 0)]  # the clamped end is square to the sheet
        for bump in range(self.given["bumps"]):
            first = foot if bump else upright
            columns += [arc((s - 1.0)*first, bump) for s in half_arc]
            self.sections[f"crest_{bump + 1}"] = len(columns) - 1
            columns += [arc(s*foot, bump) for s in half_arc]
            self.sections[f"corner_{2*bump + 1}"] = len(columns) - 1
            start = columns[-1][0]
            last = bump == self.given["bumps"] - 1
            end = self.stretch*(bump + 1)*pitch + 0.0*self.zeta if last else arc(-foot, bump + 1)[0]
            columns += [((1.0 - s)*start + s*end, self.zeta + 0.0*start) for s in flat]
            self.sections["end" if last else f"corner_{2*bump + 2}"] = len(columns) - 1
        return columns

    def bricks(self):
        """Node numbers (elements, 20) in CalculiX's order."""
        a, b, c = (2*index.ravel() for index in numpy.indices([size//2 for size in self.number.shape]))
        face = [(0, 0), (0, 2), (2, 2), (2, 0)]  # (i, j): r, theta, v are right-handed
        mids = [(0, 1), (1, 2), (2, 1), (1, 0)]
        at = [(*p, k) for k in (0, 2) for p in face] + [(*p, k) for k in (0, 2) for p in mids] + [(*p, 1) for p in face]
        return numpy.stack([self.number[a + i, b + j, c + k] for i, j, k in at], -1)

    def frame(self, i, j):
        """Directions r, theta, v at a place of the mid-surface, as rows."""
        x, y, _ = self.points[i, j, self.number.shape[2]//2]
        angle = numpy.arctan2(y, x) if self.sector else 0.0
        cosine, sine = numpy.cos(angle), numpy.sin(angle)
        return numpy.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])

    def spread(self, i):
        """Weights (across, through) of a section's nodes for a line force of 1 N/m, even through the thickness."""
        weights = numpy.zeros(self.number.shape[1:])
        at = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
        gauss = list(zip(*numpy.polynomial.legendre.leggauss(3), strict=True))
        for j in range(0, len(self.radius) - 2, 2):
            for k in range(0, weights.shape[1] - 2, 2):
                for a, weight_a in gauss:
                    slope = self.radius[j]*(a - 0.5) - 2.0*a*self.radius[j + 1] + self.radius[j + 2]*(a + 0.5)
                    for b, weight_b in gauss:
                        part = weight_a*weight_b*slope/(weights.shape[1] - 1)
                        for (p, q), shape in zip(at, shapes(a, b), strict=True):
                            weights[j + p, k + q] += part*shape
        return weights

    def held_mean(self, i):
        """Constraints of a section: its mean displacement through the thickness is zero at each place across. Lists of
        (node, factor), the first of which is in no other list."""
        rows, size = {}, self.number.shape
        for j in range(size[1]):
            row = {}
            for k in range(0, size[2] - 2, 2):
                if j % 2 == 0:
                    parts = {(j, k): 1/6, (j, k + 1): 4/6, (j, k + 2): 1/6}
                else:  # the mean of the eight shape functions half-way
                    parts = {(j, k): 1/2, (j, k + 2): 1/2}
                    for near in (j - 1, j + 1):
                        parts |= {(near, k): -1/6, (near, k + 1): 1/3, (near, k + 2): -1/6}
                for place, factor in parts.items():
                    row[place] = row.get(place, 0.0) + factor
            rows[j] = row
        for j in range(1, size[1], 2):
            for near in (j - 1, j + 1):  # what hangs on others must not stand in a second list
                factor = rows[j][near, 1]/rows[near][near, 1]
                for place, other in rows[near].items():
                    rows[j][place] = rows[j].get(place, 0.0) - factor*other
        answer = []
        for j, row in rows.items():
            first = (j, 1 - j % 2)
            others = [place for place, factor in row.items() if place != first and abs(factor) > 1.0e-12]
            answer.append([(self.number[i, *place], row[place]) for place in [first, *others]])
        return answer


def shapes(a, b):
    """The eight shape functions of a quadrilateral."""
    corners = [0.25*(1 + x*a)*(1 + y*b)*(x*a + y*b - 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return [*corners, 0.5*(1 - a*a)*(1 - b), 0.5*(1 + a)*(1 - b*b), 0.5*(1 - a*a)*(1 + b), 0.5*(1 - a)*(1 - b*b)]


def write(path, sheet, steps, element, plane, hold):
    """CalculiX's input."""
    given = sheet.given
    with open(path, "w", encoding="ascii") as out:
        print("*NODE, NSET=ALL", file=out)
        for place in numpy.argwhere(sheet.number):
            print(sheet.number[*place], *(f"{value/MILLI:.13e}" for value in sheet.points[*place]), sep=", ", file=out)
        print(f"*ELEMENT, TYPE={element}, ELSET=SHEET", file=out)
        for number, nodes in enumerate(sheet.bricks(), 1):
            print(number, *nodes[:10], sep=", ", end=",\n", file=out)
            print(*nodes[10:], sep=", ", file=out)
        print("*MATERIAL, NAME=METAL\n*ELASTIC", file=out)
        print(given["youngs_modulus"]*MILLI**2, given["poissons_ratio"], sep=", ", file=out)
        print("*SOLID SECTION, ELSET=SHEET, MATERIAL=METAL", file=out)
        print("*NSET, NSET=SECTIONS", file=out)
        for i in sheet.sections.values():
            for node in sheet.number[i][sheet.number[i] > 0]:
                print(f"{node},", file=out)
        corners = [i for name, i in sheet.sections.items() if name.startswith("corner")]
        for i in corners if hold == "mean" else ():
            for row in sheet.held_mean(i):
                print(f"*EQUATION\n{len(row)}", file=out)
                for start in range(0, len(row), 4):
                    print(", ".join(f"{node}, 3, {factor:.13e}" for node, factor in row[start:start + 4]), file=out)
        print("*BOUNDARY", file=out)
        for node in sheet.number[0][sheet.number[0] > 0]:
            print(f"{node}, 1, 3", file=out)
        for i in corners if hold == "middle" else ():
            for node in sheet.number[i, :, sheet.number.shape[2]//2]:
                if node:
                    print(f"{node}, 3, 3", file=out)
        if plane:
            print("ALL, 1, 1", file=out)
        for loads in steps:
            print("*STEP\n*STATIC\n*CLOAD, OP=NEW", file=out)
            for name, direction, size in loads:
                i = sheet.sections[name]
                force, weights = size*numpy.array(direction) @ sheet.frame(i, 0), sheet.spread(i)
                for place in numpy.argwhere(sheet.number[i]):
                    for axis_number in numpy.flatnonzero(force):
                        value = force[axis_number]*weights[*place]
                        print(f"{sheet.number[i, *place]}, {axis_number + 1}, {value:.13e}", file=out)
            print("*NODE PRINT, NSET=SECTIONS\nU, RF\n*END STEP", file=out)


def read(path, count):
    """Displacements [m] and forces [N] of the steps: two lists of arrays by node number."""
    found = {"displacements": [], "forces": []}
    rows = None
    for line in path.read_text(encoding="ascii").splitlines():
        words = line.split()
        if words and words[0] in found:
            rows = numpy.full((count + 1, 3), numpy.nan)
            found[words[0]].append(rows)
        elif words:
            rows[int(words[0])] = [float(word) for word in words[1:]]
    return [MILLI*rows for rows in found["displacements"]], found["forces"]


def solve(given, steps, mesh, sector=True, element="C3D20R", plane=False, hold="mean", ccx="ccx"):
    """Results of each step, by name: displacements of lines in r, theta, v at three radii [m]; reactions in v [N]."""
    sheet = Sheet(given, mesh, sector)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)/"strip.inp"
        write(path, sheet, steps, element, plane, hold)
        threads = {key: "1" for key in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
        ran = subprocess.run([ccx, "strip"], cwd=folder, env=os.environ | threads, capture_output=True, text=True,
                             check=False)
        if "*ERROR" in ran.stdout or ran.returncode:
            raise RuntimeError(ran.stdout[-3000:])
        moves, forces = read(path.with_suffix(".dat"), sheet.number.max())
    answers = []
    across, middle = sheet.number.shape[1] - 1, sheet.number.shape[2]//2
    for loads, move, force in zip(steps, moves, forces, strict=True):
        answer = {}
        for name, i in sheet.sections.items():
            if name != "clamp":
                rows = [sheet.frame(i, j) @ move[sheet.number[i, j, middle]] for j in (0, across//2, across)]
                for place, row in zip(PLACES, rows, strict=True):
                    answer |= {f"{name}.{place}.{way}": value for way, value in zip(WAYS, row, strict=True)}
        for name, i in sheet.sections.items():
            if name.startswith(("corner", "clamp")):
                answer[f"reaction.{name}"] = force[sheet.number[i][sheet.number[i] > 0], 2].sum()
        work = 0.0
        for name, direction, size in loads:
            i = sheet.sections[name]
            there = sheet.number[i] > 0
            toward = numpy.array(direction) @ sheet.frame(i, 0)
            work += size*(sheet.spread(i)[there]*(move[sheet.number[i][there]] @ toward)).sum()
        answer["work_of_loads"] = work
        width = given["outer_radius"] - given["inner_radius"]
        total = sum(size*direction[2] for _, direction, size in loads)*width
        left = total + sum(value for name, value in answer.items() if name.startswith("reaction"))
        if abs(left) > 1.0e-4*width*max(size for *_, size in loads):
            raise RuntimeError(f"loads and reactions do not balance: {left} N")
        answers.append(answer)
    return answers


def beam(given, steps):
    """The same strip in plane strain as a curved beam with bending, stretching and shear (Winkler's energy), by its
    flexibility: what shells give, as their kinks have no size. Displacements [m], reactions in v [N/m]."""
    height, half, pitch, thickness = (given[key] for key in ("height", "half_length", "pitch", "thickness"))
    plain = given["youngs_modulus"]/(1.0 - given["poissons_ratio"]**2)
    shear = 5/6*thickness*given["youngs_modulus"]/(2.0*(1.0 + given["poissons_ratio"]))
    bend = (half**2 + height**2)/(2.0*height)
    foot = numpy.arcsin(half/bend)
    neutral = bend - thickness/numpy.log((2*bend + thickness)/(2*bend - thickness))  # Winkler's eccentricity
    abscissae, weights = numpy.polynomial.legendre.leggauss(24)
    s, points, names = [], {}, []
    for bump in range(given["bumps"]):
        centre = half + bump*pitch
        for low, high, name in ((-foot, 0.0, f"crest_{bump + 1}"), (0.0, foot, f"corner_{2*bump + 1}")):
            for a, w in zip(abscissae, weights, strict=True):
                angle = 0.5*(low + high) + 0.5*(high - low)*a
                s.append((centre + bend*numpy.sin(angle), height - bend + bend*numpy.cos(angle), -angle,
                          0.5*(high - low)*bend*w, 1.0))
            points[name] = (centre + bend*numpy.sin(high), height - bend + bend*numpy.cos(high), len(s))
        name = "end" if bump == given["bumps"] - 1 else f"corner_{2*bump + 2}"
        for a, w in zip(abscissae, weights, strict=True):
            s.append((centre + half + (pitch - 2*half)*0.5*(1 + a), 0.0, 0.0, 0.5*(pitch - 2*half)*w, 0.0))
        points[name] = (centre + pitch - half, 0.0, len(s))
    x, v, slope, length, curved = numpy.array(s).T

    def inner(name, direction):
        """Moment, tension and shear from a unit force on the cantilever."""
        at_x, at_v, count = points[name]
        there = numpy.arange(len(x)) < count
        moment = (at_x - x)*direction[1] - (at_v - v)*direction[0]  # raises the strip's end, anticlockwise
        tension = direction[0]*numpy.cos(slope) + direction[1]*numpy.sin(slope)
        across = direction[1]*numpy.cos(slope) - direction[0]*numpy.sin(slope)
        return moment*there, tension*there, across*there

    second = numpy.where(curved > 0, thickness*neutral*bend, thickness**3/12.0)
    names = [(name, way) for name in points for way in (0, 1)]
    parts = [inner(name, ((1.0, 0.0), (0.0, 1.0))[way]) for name, way in names]
    stretch = plain*thickness
    flexible = numpy.array([[(length*(m*n/(plain*second) + p*q/stretch + a*b/shear
                              - curved*(m*q + n*p)/(stretch*bend))).sum() for n, q, b in parts] for m, p, a in parts])
    held = [index for index, (name, way) in enumerate(names) if name.startswith("corner") and way == 1]
    answers = []
    for loads in steps:
        force = numpy.zeros(len(names))
        for name, direction, size in loads:
            force[names.index((name, 0))] += size*direction[1]
            force[names.index((name, 1))] += size*direction[2]
        down = force[1::2].sum()
        force[held] = -numpy.linalg.solve(flexible[numpy.ix_(held, held)], (flexible @ force)[held])
        move = flexible @ force
        answer = {f"{name}.mean.{('theta', 'v')[way]}": move[index] for index, (name, way) in enumerate(names)}
        answer |= {f"reaction.{names[index][0]}": force[index] for index in held}
        answer["reaction.clamp"] = -down - force[held].sum()
        answers.append(answer)
    return answers


def thin_plate(given, line_force, order=14):
    """Deflection downwards of a clamped flat sector under a line force along its free ray, at three radii [m]: a plate
    of Kirchhoff by Ritz's method with polynomials."""
    inner, outer = given["inner_radius"], given["outer_radius"]
    mean, half = 0.5*(inner + outer), 0.5*(outer - inner)
    poisson, angle = given["poissons_ratio"], given["length"]/mean
    rigidity = given["youngs_modulus"]*given["thickness"]**3/(12.0*(1.0 - poisson**2))
    abscissae, weights = numpy.polynomial.legendre.leggauss(order + 6)
    radius, theta = mean + half*abscissae, 0.5*angle*(1.0 + abscissae)
    unit = numpy.eye(order)
    legendre = numpy.polynomial.legendre

    def along_radius(s, rate):
        return numpy.array([legendre.legval(s, legendre.legder(row, rate)) for row in unit])/half**rate

    def along_angle(s, rate):  # (1 + s)^2 times Legendre's: clamped at s = -1
        rows = [legendre.legder(legendre.legmul([4/3, 2.0, 2/3], row), rate) for row in unit]
        return numpy.array([legendre.legval(s, row) for row in rows])*(2.0/angle)**rate

    def product(a, b, power=0):
        table = numpy.einsum("mi,nj,i->mnij", along_radius(abscissae, a), along_angle(abscissae, b), radius**-power)
        return table.reshape(order*order, -1)

    bends = [product(2, 0), product(1, 0, 1) + product(0, 2, 2), product(1, 1, 1) - product(0, 1, 2)]
    area = (numpy.outer(weights*radius, weights)*half*0.5*angle).ravel()
    first, second, twist = bends
    stiffness = rigidity*(((first + second)*area) @ (first + second).T - (1.0 - poisson)*(
        (first*area) @ second.T + (second*area) @ first.T - 2.0*(twist*area) @ twist.T))
    force = line_force*half*numpy.outer(along_radius(abscissae, 0) @ weights, along_angle(1.0, 0)).ravel()
    found = numpy.linalg.lstsq(stiffness, force, rcond=1.0e-14)[0].reshape(order, order)
    return along_radius(numpy.array([-1.0, 0.0, 1.0]), 0).T @ found @ along_angle(1.0, 0)


def rounded(value):
    return float(f"{value:.6e}")


def named(loads):
    return [{"line": line, "direction": way, "size": size} for line, way, size in loads]


def nested(answer):
    """Flat names as groups: (r, theta, v) of each line at three radii, and reactions."""
    lines = dict.fromkeys(name.split(".")[0] for name in answer if name.endswith(".r"))
    return {"displacement": {line: {place: [rounded(answer[f"{line}.{place}.{way}"]) for way in WAYS]
                                    for place in PLACES} for line in lines},
            "reaction": {name.split(".")[1]: rounded(value) for name, value in answer.items() if "reaction" in name},
            "work_of_loads": rounded(answer["work_of_loads"])}


def converged(name, given, cases, meshes, sector, ccx):
    """Rows of the file for load cases of one strip: `cases` are (id, what, loads). The error of a number is the larger
    of its changes from the last but one mesh and from reduced to full integration."""
    runs = [*((mesh, "C3D20R") for mesh in meshes), (meshes[-1], "C3D20")]
    steps = [loads for *_, loads in cases]
    found = []
    for mesh, element in runs:
        print(name, element, mesh, flush=True)
        found.append(solve(given, steps, mesh, sector, element, ccx=ccx))
    rows = []
    for number, (case, what, loads) in enumerate(cases):
        coarse, fine, full = (answers[number] for answers in found[-3:])
        largest = max(abs(value) for key, value in fine.items() if key.endswith((".r", ".theta", ".v")))
        error = {}
        for key, value in fine.items():
            digits = DIGITS*(largest if key.endswith((".r", ".theta")) else abs(value))
            error[key] = max(abs(value - coarse[key]), abs(value - full[key]), digits)
        rows.append({"id": case, "what": what,
                     "input": given | {"shape": "sector" if sector else "straight", "line_force": named(loads)},
                     "output": nested(fine), "error": nested(error),
                     "meshes": [mesh | {"element": element} | nested(answers[number])
                                for (mesh, element), answers in zip(runs, found, strict=True)]})
    return rows


def controls(ccx, quick):
    """Checks of the method by closed forms and other ways to hold and press."""
    what = ("straight strip with u_r = 0 against a curved beam (Winkler's energy, shear factor 5/6); the rest is the "
            "size of the kinks, and is halved with the thickness")
    answer = {"plane_strain": {"what": what, "rows": []}}
    for thickness, loads in ((1.0e-4, PRESS), (1.0e-4, RUB), (5.0e-5, THIN)):
        given = STRIP | {"thickness": thickness}
        solid, = solve(given, [loads], NARROW, sector=False, plane=True, ccx=ccx)
        bent, = beam(given, [loads])
        width = given["outer_radius"] - given["inner_radius"]
        bent = {key: value*(width if "reaction" in key else 1.0) for key, value in bent.items()}
        keys = [key for key in bent if "reaction" in key or (key.startswith(("crest", "end")) and key.endswith(".v"))
                or (key.startswith(("corner", "end")) and key.endswith(".theta"))]
        answer["plane_strain"]["rows"].append(
            {"thickness": thickness, "line_force": named(loads),
             "solid": {key: rounded(solid[key]) for key in keys}, "beam": {key: rounded(bent[key]) for key in keys}})
    keys = [*(f"{line}.{place}.v" for line in ("crest_1", "crest_2") for place in PLACES), "corner_1.mean.theta",
            "end.mean.theta", *(f"reaction.{name}" for name in ("clamp", "corner_1", "corner_2", "corner_3"))]

    def change(one, other):
        return {key: float(f"{other[key]/one[key] - 1.0:.2e}") for key in keys}

    mean = solve(STRIP, [PRESS, RUB], MESHES[1], ccx=ccx)
    middle = solve(STRIP, [PRESS, RUB], MESHES[1], hold="middle", ccx=ccx)
    answer["held_at_the_mid_surface"] = {
        "what": "A and C on the second mesh with corners held at the nodes of the mid-surface: relative change",
        "A": change(mean[0], middle[0]), "C": change(mean[1], middle[1])}
    plate = thin_plate(PLATE, TIP[0][2])
    answer["thin_plate"] = {"what": "case D by a plate of Kirchhoff (Ritz, polynomials): v of the end at r_i, r_m, r_o",
                            "v": [rounded(-value) for value in plate],
                            "v_lower_order": [rounded(-value) for value in thin_plate(PLATE, TIP[0][2], 10)]}
    if not quick:
        two = solve(STRIP, [PRESS, RUB], MESHES[-1], True, "C3D20R", ccx=ccx)
        four = solve(STRIP, [PRESS, RUB], MESHES[-1] | {"layers": 4}, True, "C3D20R", ccx=ccx)
        answer["four_layers"] = {"what": "A and C on the third mesh with four layers in place of two: relative change",
                                 "A": change(two[0], four[0]), "C": change(two[1], four[1])}
    return answer


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ccx", default="ccx")
    parser.add_argument("--quick", action="store_true")
    chosen = parser.parse_args()
    meshes = MESHES[:2] if chosen.quick else MESHES
    version = subprocess.run([chosen.ccx, "-v"], capture_output=True, text=True, check=False).stdout.split()[-1]
    pressed = ("A", "sector, both crests pressed", PRESS)
    rubbed = ("C", "sector, first crest rubbed", RUB)
    sector = converged("A, C", STRIP, [pressed, rubbed], meshes, True, chosen.ccx)
    straight = converged("B", STRIP, [("B", "straight strip, both crests pressed", PRESS)], meshes, False, chosen.ccx)
    halved = ("A-thin", "A with half the thickness and an eighth of the force: the kinks' share is halved", THIN)
    thin = converged("A-thin", STRIP | {"thickness": 5.0e-5}, [halved], meshes, True, chosen.ccx)
    plate = ("D", "flat sector without bumps, its free ray pressed", TIP)
    flat = converged("D", PLATE, [plate], MESHES[:2], True, chosen.ccx)
    result = {
        "what": "curved bump strips of a thrust bearing's sector, and straight ones, as solids of 20-node bricks; SI",
        "computed": {"by": f"sector_strip.py with CalculiX {version}; nothing of it by gfb",
                     "on": datetime.date.today().isoformat()},
        "frame": "displacements are (r, theta, v) in metres, theta along the circle; in a straight strip r is axial "
                 "and theta along the strip; v upwards, away from the sleeve",
        "geometry": "from the fixed edge on an arc, a flat, an arc, a flat; half_length and pitch at r_m, the mean of "
                    "both radii; x along the strip at r_m is theta = x/r_m at every radius, the height does not depend "
                    "on r; constant thickness normal to the mid-surface; mitred kinks; the clamped end square to it",
        "supports": "clamp: all displacements of the end face are zero; corner_1 to corner_3: the mean of v through "
                    "the thickness along the kink is zero, nothing else; loads are even along r (N/m) and through the "
                    "thickness; D: the clamp only",
        "output": "of the mid-surface; reactions in v are integrated over r [N]; work_of_loads: sum of force times "
                  "displacement [J]; from the last but one row of `meshes`",
        "error": "the larger of the changes from the last but one mesh and from reduced to full integration",
        "meshes": "elements an arc, a flat, across r (dense at the edges) and through the thickness; dense at kinks "
                  "and crests, too; D: twice an arc's along; C3D20R: reduced integration, C3D20: full",
        "cases": [sector[0], straight[0], sector[1], thin[0], flat[0]], "controls": controls(chosen.ccx, chosen.quick)}
    text = json.dumps(result, indent=1)
    text = re.sub(r"\[\s+(-?[\d.e+-]+),\s+(-?[\d.e+-]+),\s+(-?[\d.e+-]+)\s+\]", r"[\1, \2, \3]", text) + "\n"
    if not chosen.quick:
        pathlib.Path(__file__).with_suffix(".json").write_text(text, encoding="ascii")
    for row in result["cases"]:
        table(row)
    print(json.dumps(result["controls"], indent=1))


def table(row):
    """Numbers and errors of a case, in micrometres and newtons."""
    print(f"\n{row['id']}: {row['what']}")
    for line, places in row["output"]["displacement"].items():
        for place, values in places.items():
            errors = row["error"]["displacement"][line][place]
            numbers = (f"{way} {1.0e6*value:11.5f} +- {1.0e6*error:8.5f}"
                       for way, value, error in zip(WAYS, values, errors, strict=True))
            print(f"{line:10}{place:7}", *numbers)
    for name, value in row["output"]["reaction"].items():
        print(f"{name:10}reaction {value:10.5f} +- {row['error']['reaction'][name]:8.5f} N")
    print(f"work of loads {row['output']['work_of_loads']:.6e} +- {row['error']['work_of_loads']:.1e} J")


if __name__ == "__main__":
    main()
