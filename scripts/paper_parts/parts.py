"""The parts of `make paper`: which runs each needs, and what it makes of their reports."""
import typing

from paper_parts import methods, pictures, tables, time_table
from paper_parts.methods import CUT_THROUGH, SCENES, TEAR, TIMED
from paper_parts.runs import COARSE, Run, peer_runs


class Part(typing.NamedTuple):
    runs: list
    heading: str              # of its table in docs/paper.md; empty: it has none
    rows: typing.Callable     # of its table, from the reports of all runs
    timed: bool = False       # its runs have the machine for themselves
    kept: bool = False        # it reads the bags of its runs


def with_texts(texts, scenes=SCENES):
    return [Run(scene, text) for scene in scenes for text in texts.values()]


PARTS = {
    "accuracy": Part(with_texts(methods.compared()), "Accuracy", tables.accuracy),
    "worth": Part(with_texts(methods.parts()), "What each part is worth", tables.worth),
    "simulators": Part(with_texts(methods.simulators()), "Other simulators in the tracker's place", tables.simulators),
    "features": Part(with_texts(methods.counts()), "Number of features", tables.features),
    "sizes": Part([Run(scene) for scene in TIMED.values()], "Table 1: models", tables.sizes),
    "coarse": Part([Run(scene, model=COARSE) for scene in tables.COARSE_SCENES], "The doll with the paper's resolution",
                   tables.coarse_doll),
    "times": Part(with_texts(methods.timed_kinds(), TIMED.values()), "Table 2: times", time_table.times, timed=True),
    "peers": Part([], "Peers", lambda _: tables.peers(peer_runs())),
    "cutting": Part([Run(scene) for scene in CUT_THROUGH], "Cutting", tables.cutting, timed=True),
    "tearing": Part([Run(TEAR)], "Tearing", tables.tearing),
    "figures": Part(pictures.RUNS, "", pictures.draw_figures, kept=True),
}
