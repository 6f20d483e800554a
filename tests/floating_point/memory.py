"""Small scenes under valgrind: no wrong access, nothing used before it is set, nothing lost that gfb allocated."""

import dataclasses
import pathlib
import tempfile
import time
import xml.etree.ElementTree

from builds import options_of  # first: it says where the following are
from gfb.program import call, command_of
from gfb.running import write_case

SECONDS = 1800
HERE = pathlib.Path(__file__).resolve().parent
SUPPRESSIONS = (HERE/"libraries.supp", pathlib.Path("/usr/share/openmpi/openmpi-valgrind.supp"))
LEAK = "Leak_DefinitelyLost"


@dataclasses.dataclass
class Look:
    """What valgrind saw of a scene."""

    scene: object
    errors: list = dataclasses.field(default_factory=list)  # words
    lost: list = dataclasses.field(default_factory=list)    # words: blocks that gfb allocated
    others: int = 0                                         # blocks that libraries allocated and lost
    seconds: float = 0.0

    @property
    def wrong(self):
        """All that must not be."""
        return self.errors + self.lost


def look_at(scene, gfb):
    """Runs a scene under valgrind, on one rank."""
    look = Look(scene)
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path = write_case(folder, scene.name, scene.case)
        for more in ((), ("--restart",)) if scene.restart else ((),):
            look_once(look, command_of(gfb, path, folder, options=[*options_of(scene), *more]), folder/"seen.xml")
    look.seconds = time.monotonic() - begun
    return look


def look_once(look, command, report):
    """One run."""
    suppressions = [f"--suppressions={path}" for path in SUPPRESSIONS if path.exists()]
    done = call(["valgrind", "--tool=memcheck", "--xml=yes", f"--xml-file={report}", "--num-callers=40",
                 "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=definite", *suppressions,
                 *command], SECONDS, folder=report.parent)  # a .valgrindrc of the folder in which the tool is called is not read
    if done.status != look.scene.status:
        look.errors.append(f"status {done.status}, not {look.scene.status}:\n{(done.log + done.complaint)[-2500:]}")
    try:
        root = xml.etree.ElementTree.parse(report).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as wrong:
        look.errors.append(f"no report of valgrind's: {wrong}")
        return
    read_report(look, root)


def read_report(look, root):
    """Sorts valgrind's errors; a place counts once, wherever it was called from."""
    places = set()
    for error in root.iter("error"):
        frames = error.find("stack").findall("frame")
        kind = error.findtext("kind")
        place = kind, stack_words(frames[:4])
        words = f"{error.findtext('what') or error.findtext('xwhat/text')}\n{stack_words(frames)}"
        if kind == LEAK and not own(allocator(frames)):
            look.others += 1
        elif place not in places:
            (look.lost if kind == LEAK else look.errors).append(words)
        places.add(place)


def allocator(frames):
    """The frame that called malloc or one of its kin, which valgrind replaces."""
    return next((frame for frame in frames if "vgpreload" not in frame.findtext("obj", "")), frames[-1])


def own(frame):
    """Whether a frame is gfb's."""
    return pathlib.Path(frame.findtext("obj", "")).name == "gfb"


def stack_words(frames):
    """Frames, for people."""
    return "\n".join(f"    {frame.findtext('fn', '?')} ({frame.findtext('file', pathlib.Path(frame.findtext('obj', '?')).name)}"
                     f":{frame.findtext('line', '?')})" for frame in frames)
