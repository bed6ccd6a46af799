"""The paper's figures beside ours in README.md, from the tables in docs/paper.md."""
from evaluation.figures import PAPER_MEAN_ERROR_MM, number
from markdown_lines import table
from paper_parts.methods import OURS, TIMED, WITH_PD, timed_kinds

WORDS = {"sponge": "sponge", "doll": "soft toy"}
ERRORS, TIMES = "Accuracy", "Table 2: times"


def rows_of(text):
    """Cells of the first table in a text, without its head."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def of_body(cells, body, count):
    """The cells of one body, which has so many of them."""
    first = list(TIMED).index(body) * count
    return cells[first:first + count]


def readme_lines(sections):
    """The table, from the sections of docs/paper.md by their headings."""
    errors = {row[0]: row[1:] for row in rows_of(sections[ERRORS])}
    times = {(row[0], row[1]): row[2:] for row in rows_of(sections[TIMES])}
    rows = [[f"{words}, mean error, bent / pushed [mm]", number(PAPER_MEAN_ERROR_MM),
             *(" / ".join(of_body(errors[method], body, 2)) for method in (WITH_PD, OURS))]
            for body, words in WORDS.items()]
    kinds = ["paper", *timed_kinds()]
    shown = [kinds.index(kind) for kind in ("paper", "its method here", OURS)]
    for part, what in (("per frame", "time of a frame"), ("Init.", "initialization without registration")):
        bodies = [of_body(times[(part, "Total")], body, len(kinds)) for body in WORDS]
        rows.append([f"{' / '.join(WORDS.values())}, {what} [ms]",
                     *(" / ".join(cells[column] for cells in bodies) for column in shown)])
    return table(["", "paper", "its method here", "ours"], rows)
