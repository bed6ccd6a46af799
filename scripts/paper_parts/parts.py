"""The parts of `make paper`: which runs each needs, and what it makes of their reports."""
import typing

from paper_parts import methods, pictures, tables, time_table
from paper_parts.methods import CUT_THROUGH, SCENES, TEAR, TIMED
from paper_parts.runs import COARSE, Run, peer_runs


class Part(typing.NamedTuple):
    runs: list
    section: typing.Callable  # the lines of its section, from the reports of all runs
    timed: bool = False       # its runs have the machine for themselves
    kept: bool = False        # it reads the bags of its runs


def with_texts(texts, scenes=SCENES):
    return [Run(scene, text) for scene in scenes for text in texts.values()]


PARTS = {
    "accuracy": Part(with_texts(methods.compared()), tables.accuracy),
    "worth": Part(with_texts(methods.parts()), tables.worth),
    "simulators": Part(with_texts(methods.simulators()), tables.simulators),
    "features": Part(with_texts(methods.counts()), tables.features),
    "sizes": Part([Run(scene) for scene in TIMED.values()], tables.sizes),
    "coarse": Part([Run(scene, model=COARSE) for scene in tables.COARSE_SCENES], tables.coarse_doll),
    "times": Part(with_texts(methods.timed_kinds(), TIMED.values()), time_table.times, timed=True),
    "peers": Part([], lambda _: tables.peers(peer_runs())),
    "cutting": Part([Run(scene) for scene in CUT_THROUGH], tables.cutting, timed=True),
    "tearing": Part([Run(TEAR)], tables.tearing),
    "figures": Part(pictures.RUNS, pictures.draw_figures, kept=True),
}
