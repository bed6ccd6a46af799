"""The rows of Table 2 in docs/paper.md."""
from evaluation.figures import PAPER_TIMES_MS
from pages import number
from paper_parts.methods import TIMED, TIMED_KINDS
from paper_parts.runs import Run

FIRST = " (initialization)"
STAGES = ("Feature-Point Tracking", "Soft-body Simulation", "Resolution Enhancement")
PAPER = "paper"
COLUMNS = [(body, whose) for body in TIMED for whose in (PAPER, *TIMED_KINDS)]


def stage_times(reports, stage, initialization):
    """Medians [ms] of each column; None if it was not measured."""
    of_paper = PAPER_TIMES_MS.get(stage + FIRST * initialization, {})
    for body, whose in COLUMNS:
        stages = [] if whose == PAPER else reports[Run(TIMED[body], TIMED_KINDS[whose])].get("stages", [])
        found = (entry["median_ms"] for entry in stages
                 if entry["stage"] == stage and entry["initialization"] == initialization)
        yield of_paper.get(body) if whose == PAPER else next(found, None)


def totals(reports, initialization):
    """Sums [ms] of the paper's three stages, by (body, whose)."""
    columns = zip(*(stage_times(reports, stage, initialization) for stage in STAGES))
    return {key: None if None in values else sum(values) for key, values in zip(COLUMNS, columns)}


def rows_of(reports, words, initialization, stages=STAGES):
    return [[words, stage, *map(number, stage_times(reports, stage, initialization))] for stage in stages]


def times(reports):
    initial, per_frame = (totals(reports, initialization).values() for initialization in (True, False))
    return [*rows_of(reports, "Init.", True), ["Init.", "Total", *map(number, initial)],
            *rows_of(reports, "Init.", True, ("Model Registration", "Tracker Preparation")),
            *rows_of(reports, "per frame", False), ["per frame", "Total", *map(number, per_frame)],
            ["", "frames a second", *(number(None if not total else 1000 / total, 0) for total in per_frame)]]
