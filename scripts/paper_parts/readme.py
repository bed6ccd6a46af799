"""The paper's figures beside ours in README.md."""
from evaluation.figures import PAPER_MEAN_ERROR_MM
from pages import number
from paper_parts.methods import OURS, SCENES, WITH_PD, compared
from paper_parts.tables import errors
from paper_parts.time_table import PAPER, totals

WORDS = {"sponge": "sponge", "doll": "soft toy"}
SHOWN = {PAPER: PAPER, "its method here": WITH_PD, OURS: OURS}  # columns: kind of time, method of accuracy


def error_rows(reports):
    """One row for each body, of the two scenes that it has."""
    means = {method: errors(reports, text) for method, text in compared().items()}
    rows = []
    for first, words in zip(range(0, len(SCENES), 2), WORDS.values()):
        ours = (" / ".join(means[method][first:first + 2]) for kind, method in SHOWN.items() if kind != PAPER)
        rows.append([f"{words}, mean error of scenes {' / '.join(SCENES[first:first + 2])} [mm]",
                     number(PAPER_MEAN_ERROR_MM), *ours])
    return rows


def time_row(reports, what, initialization):
    times = totals(reports, initialization)
    return [f"{' / '.join(WORDS.values())}, {what} [ms]",
            *(" / ".join(number(times[(body, kind)]) for body in WORDS) for kind in SHOWN)]


def readme_rows(reports):
    return [*error_rows(reports), time_row(reports, "time of a frame", False),
            time_row(reports, "initialization without the search", True)]
