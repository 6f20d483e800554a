#!/usr/bin/env python3
"""Hard scenes, each with what must come out: an answer that something else confirms, or a refusal by name.

  hard_scenes.py                 plays all scenes; status 1 where one does not end as it must
  hard_scenes.py WORD ...        those whose part or words have one of these in them
  hard_scenes.py --share 1/2     every second scene from the first on
  hard_scenes.py --page FILE     writes the table of all as Markdown
"""

import argparse
import pathlib
import sys

import film_scenes
import foil_scenes
import strip_scenes
from hard_trial import played

SCENES = film_scenes.SCENES + foil_scenes.SCENES + strip_scenes.SCENES
HEAD = """# Hard cases

Written by `tests/hard/hard_scenes.py --page docs/measured/hard_cases.md`; run by `tools/test --hard`.

Scenes at the ends of what gfb computes. Each has something that must come out and that does not come from gfb: a
closed form, an invariant of the ring, the balance of forces, a limit, a monotone change, the same by two methods (full
and condensed, half and whole width, fixed and free, other units, other starts, other steps), or a refusal by name where
there is no answer: a touch-down, a fold, or a scene that is refused as it is read. Besides, every run must end with
status 0 or 2 (1 where it is refused as it is read), without NaN, and within a bound on its Newton iterations.

Iterations and factorizations are those of the most expensive run of a scene, the time that of all its runs.

A rigid film with ripples is nothing a case file can ask for; `tests/unit/formulas/film/film_convergence_test.pf` has one, three and
a half waves of a tenth of the gap without side leakage, 16 elements a wave, against Runge-Kutta's method. At a bearing
number of 1000 Galerkin's largest error is 0.15 p_a, its undershoot 0.14 p_a; SUPG's 6e-4 p_a, with no undershoot; at
100 they are 0.016 and 0.002 p_a, at 10 both 0.001 p_a, none with an undershoot.
"""


def outcome(scene, trial):
    """As it must, as is known, or neither."""
    if not trial.failures:
        return "was known to fail, but does not" if scene.limit else "ok"
    return "known limit" if scene.limit and not trial.broken else "FAILED"


def show(scene, trial):
    """A line a scene, and what is wrong with it."""
    print(f"{outcome(scene, trial):12} {scene.part}: {scene.words}\n             {'; '.join(trial.outcomes)}"
          f" [{trial.iterations} of {scene.iterations} iterations, {trial.factorizations} factorizations, "
          f"{trial.runs} runs, {trial.claims} claims, {trial.seconds:.1f} s]", flush=True)
    for words in trial.failures:
        print(f"             {words}", flush=True)


def cell(words):
    """Words that fit into a table."""
    return " ".join(words.replace("|", "/").split())


def page(results):
    """The Markdown of all scenes."""
    lines = [HEAD]
    good = sum(not trial.failures for _, trial in results)
    lines.append(f"{len(results)} scenes, {sum(trial.runs for _, trial in results)} runs, "
                 f"{sum(trial.claims for _, trial in results)} claims: {good} scenes end as they must, "
                 f"{len(results) - good} are known limits.\n")
    for part in dict.fromkeys(scene.part for scene, _ in results):
        lines += [f"## {part}\n", "| scene | outcome | Newton iterations (bound) | factorizations | runs | time [s] |",
                  "| --- | --- | ---: | ---: | ---: | ---: |"]
        for scene, trial in results:
            if scene.part == part:
                words = "; ".join(trial.outcomes) if not trial.failures else f"**{outcome(scene, trial)}**"
                lines.append(f"| {cell(scene.words)} | {cell(words)} | {trial.iterations} ({scene.iterations}) | "
                             f"{trial.factorizations} | {trial.runs} | {trial.seconds:.1f} |")
        lines.append("")
    lines.append("## Known limits\n")
    lines.append("These scenes stay as they are; what must come out stands in their words. The suite fails where one "
                 "of them begins to succeed, so that this list stays true.\n"
                 if any(trial.failures for _, trial in results) else "None of these scenes is one today.")
    for scene, trial in results:
        if trial.failures:
            lines.append(f"- **{cell(scene.part)}: {cell(scene.words)}.** {scene.limit[:1].upper()}{scene.limit[1:]}. "
                         f"Measured: {cell('; '.join(trial.failures))}.")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", help="parts of the names of scenes")
    parser.add_argument("--share", default="1/1", help="which of so many shares of the scenes, such as 2/3")
    parser.add_argument("--page", type=pathlib.Path, help="Markdown file to write")
    arguments = parser.parse_args()
    chosen = [scene for scene in SCENES if not arguments.words
              or any(word in f"{scene.part}: {scene.words}" for word in arguments.words)]
    if arguments.page and arguments.share != "1/1":
        parser.error("--page is for all scenes")
    share, shares = map(int, arguments.share.split("/"))
    results = []
    for scene in chosen[share - 1::shares]:
        trial = played(scene)
        results.append((scene, trial))
        show(scene, trial)
    wrong = [outcome(*result) for result in results if outcome(*result) not in ("ok", "known limit")]
    print(f"{len(results)} scenes, {sum('ok' == outcome(*result) for result in results)} as they must, "
          f"{len(wrong)} wrong, "
          f"{sum('known limit' == outcome(*result) for result in results)} known limits, "
          f"{sum(trial.seconds for _, trial in results):.0f} s")
    if arguments.page and not wrong:
        arguments.page.write_text(page(results), encoding="utf-8")
    sys.exit(1 if wrong or not results else 0)


if __name__ == "__main__":
    main()
