"""The parts of `make paper`: which runs each needs, and what it makes of their reports."""
import typing

from paper_parts import methods, pictures, tables, time_table
from paper_parts.methods import CUT_THROUGH, SCENES, TEAR, TIMED
from paper_parts.runs import COARSE, Run


class Part(typing.NamedTuple):
    runs: list
    heading: str              # of its table in docs/paper.md; empty: it has none
    rows: typing.Callable     # of its table, from the reports of all runs
    timed: bool = False       # its runs have the machine for themselves
    kept: bool = False        # it reads the bags of its runs


def with_texts(texts, scenes=SCENES):
    return [Run(scene, text) for scene in scenes for text in texts.values()]


def compared(heading, texts):
    """A part whose table has the errors of methods."""
    return Part(with_texts(texts), heading, lambda reports: tables.error_rows(reports, texts))


PARTS = {
    "accuracy": Part(with_texts(methods.COMPARED), "Accuracy", tables.accuracy),
    "worth": compared("What each part is worth", methods.WORTH),
    "simulators": compared("Other simulators in the tracker's place", methods.SIMULATORS),
    "features": Part(with_texts(methods.COUNTS), "Number of features", tables.features),
    "sizes": Part([Run(scene) for scene in TIMED.values()], "Table 1: models", tables.sizes),
    "coarse": Part([Run(scene, model=COARSE) for scene in tables.COARSE_SCENES], "The doll with the paper's resolution",
                   tables.coarse_doll),
    "times": Part(with_texts(methods.TIMED_KINDS, TIMED.values()), "Table 2: times", time_table.times, timed=True),
    "peers": Part([], "Peers", tables.peers),
    "cutting": Part([Run(scene) for scene in CUT_THROUGH], "Cutting", tables.cutting, timed=True),
    "tearing": Part([Run(TEAR)], "Tearing", tables.tearing),
    "figures": Part(pictures.RUNS, "", pictures.draw_figures, kept=True),
}
