"""docs/evaluation.md, and the short table in README.md, from the reports of `evaluate`."""
import datetime
import subprocess

from evaluation_goals import goal_table
from evaluation_tables import (absences, accuracy, cuts, faults, long_runs, moving_camera, noise, stage_times, toys,
                               volumes)

BEGIN, END = "<!-- evaluation begin: written by make evaluate -->", "<!-- evaluation end -->"


def commit(root):
    run = subprocess.run(["git", "-C", root, "describe", "--always", "--dirty"], stdout=subprocess.PIPE, text=True,
                         check=False)
    return run.stdout.strip() or "unknown"


def origin(root):
    return f"`make evaluate` on {datetime.date.today()} at commit {commit(root)}"


def document(root, reports):
    lines = ["# Evaluation", "", f"Written by {origin(root)}.", "",
             "The virtual camera's recordings (default seed and noise, 640 x 480 at 30 Hz) tracked by `replay` and",
             "compared with the exact truth; `-`: not measured. [What each figure means](figures.md).", "",
             "## Goals", "", "What of an error volume and material leave, however a body is tracked: [below](#what-the-volume-allows).",
             "", *goal_table(reports)]
    for part in (accuracy, noise, moving_camera, volumes, long_runs, absences, cuts, faults, toys, stage_times):
        lines += part(reports)
    return "\n".join(lines).rstrip() + "\n"


def replace(path, text):
    temporary = path.with_suffix(".tmp")
    temporary.write_text(text)
    temporary.rename(path)


def write(root, text, reports):
    """docs/evaluation.md, and the goals between the marks in README.md."""
    readme = root / "README.md"
    before, rest = readme.read_text().split(BEGIN)
    after = rest.split(END)[1]
    quoted = "\n".join([f"Measured by {origin(root)}:", "", *goal_table(reports)])
    replace(root / "docs/evaluation.md", text)
    replace(readme, f"{before}{BEGIN}\n{quoted}{END}{after}")
