"""docs/evaluation.md, and the table in README.md, from the reports of `evaluate`."""
import datetime
import os
import re
import subprocess

from evaluation.goals import goal_table
from evaluation.open_loop import open_loop
from evaluation.summary import summary_table
from evaluation.tables import (absences, accuracy, cluttered, cuts, faults, forces, long_runs, moving_camera, noise,
                               stage_times, toys, volumes)
from evaluation.world_tables import (CALIBRATION_PLOT, plain_bodies, plot_calibration, predicted_errors,
                                     textures, wrong_objects)
from markdown_lines import paragraph
from replace_file import replace_file

BEGIN, END = "<!-- evaluation begin: written by make evaluate -->", "<!-- evaluation end -->"


def commit(root):
    """The commit, with "-dirty" if other files than documents were changed since."""
    def git(*arguments):
        return subprocess.run(["git", "-C", root, *arguments], stdout=subprocess.PIPE, text=True, check=False).stdout

    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs", ":!README.md")
    return (git("describe", "--always").strip() or "unknown") + ("-dirty" if changed else "")


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE)
    return f"{found[1] if found else 'unknown processor'}, {os.cpu_count()} cores"


def origin(root):
    return f"`make evaluate` on {datetime.date.today()} at commit {commit(root)}"


def document(root, reports):
    lines = ["# Evaluation", "", f"Written by {origin(root)}.", "",
             *paragraph("The recordings come from the virtual camera (default seed and noise, 640 x 480 at 30 Hz). "
                        "`replay` tracks them, and `evaluate` compares the results with the exact truth. `-` means "
                        "not measured. See also the [scenes](virtual_camera.md#scenes) and the [definitions of the "
                        "metrics](metrics.md)."), "",
             "## Goals", "",
             *paragraph("A part of the error comes from the volume (the tets) and its material. Tracking can hardly "
                        "remove this part: [what the volume allows](#what-the-volume-allows)."), "",
             *goal_table(reports)]
    for part in (accuracy, plain_bodies, textures, cluttered, noise, moving_camera, volumes, long_runs, absences, cuts,
                 forces, open_loop, faults, predicted_errors, wrong_objects, toys, stage_times):
        lines += part(reports)
    return "\n".join(lines).rstrip() + "\n"


def write(root, text, reports):
    """docs/evaluation.md, and the figures between the marks in README.md."""
    readme = root / "README.md"
    before, rest = readme.read_text().split(BEGIN)
    after = rest.split(END)[1]
    quoted = "\n".join([f"Measured by {origin(root)}:", "", *summary_table(reports)])
    plot_calibration(reports, root / CALIBRATION_PLOT)
    replace_file(root / "docs/evaluation.md", text)
    replace_file(readme, f"{before}{BEGIN}\n{quoted}{END}{after}")
