"""docs/starts.md, from the results of starts.py."""
import datetime
import statistics

from evaluation.document import commit
from evaluation.figures import get, number
from evaluation.starts import SEEDS, START_S, WRONG_MM
from markdown_lines import paragraph, table

MOST_RATIO = 1.2
PARTS = ("all", "visible")


def tracking_frames(report):
    """(time since the first frame [s], mean error [mm] or None) of the frames called TRACKING."""
    error = get(report, "vertex_error") or {}
    rows = zip(error.get("frame_times_s", []), report.get("frame_states", []), error.get("frame_mean_mm", []))
    return [(error["first_time_s"] + time, mean) for time, state, mean in rows if state == "tracking"]


def started(report):
    frames = tracking_frames(report)
    return bool(frames) and frames[0][0] <= START_S


def elsewhere(report):
    return sum(mean is not None and mean > WRONG_MM for _, mean in tracking_frames(report))


def mean_mm(report, part):
    return get(report, "vertex_error", part, "mean_mm")


def ratio(report, alone, part):
    mean, usual = mean_mm(report, part), mean_mm(alone, part)
    return None if mean is None or not usual else mean / usual


def reaches_all(report, alone):
    times = ratio(report, alone, "all")
    return started(report) and times is not None and times <= MOST_RATIO


def middle_and_worst(values):
    """"median (largest)" of what was measured."""
    known = [value for value in values if value is not None]
    return f"{number(statistics.median(known))} ({number(max(known))})" if known else "-"


def median_mm(reports, part):
    known = [mean for mean in (mean_mm(report, part) for report in reports) if mean is not None]
    return number(statistics.median(known)) if known else "-"


def start_rows(starts):
    for scene in dict.fromkeys(name for name, _, _ in starts):
        pairs = [(report, alone) for name, report, alone in starts if name == scene]
        yield [f"`{scene}`", f"{sum(started(report) for report, _ in pairs)} of {len(pairs)}",
               *[middle_and_worst(ratio(*pair, part) for pair in pairs) for part in PARTS],
               *[f"{median_mm([report for report, _ in pairs], part)} / {median_mm([alone for _, alone in pairs], part)}"
                 for part in PARTS],
               sum(reaches_all(*pair) for pair in pairs), sum(elsewhere(report) for report, _ in pairs)]


def outcome(report):
    frames = tracking_frames(report)
    if not frames:
        return "not found"
    return "wrong" if elsewhere(report) else "right"


def free_rows(free):
    for scene in dict.fromkeys(name for name, _ in free):
        outcomes = [outcome(report) for name, report in free if name == scene]
        yield [f"`{scene}`", *[outcomes.count(which) for which in ("right", "not found", "wrong")]]


def document(root, starts, free):
    lines = ["# Starts among other things", "",
             f"Written by `make starts` on {datetime.date.today()} at commit {commit(root)}.", "",
             *paragraph(f"Each scene has {len(SEEDS)} layouts, one for each seed, and a body with a weak texture. "
                        "`replay` tracks the first second from a rough pose: at most 12 mm and 10 degrees from the "
                        "truth, by chance. The same body alone, at the same place and from the same rough pose, is the "
                        "comparison. See the [scenes](virtual_camera.md#scenes)."), "",
             *paragraph(f"Started: TRACKING within {START_S} s. Error ratio: mean error divided by that of the body "
                        "alone; median, and the largest in parentheses. Seen: the vertices that nothing hides in the "
                        "scene. In mm: medians of the mean error, in the scene / alone. All goals: started, and an "
                        f"error ratio of at most {MOST_RATIO}. Elsewhere: frames called TRACKING with a mean error "
                        f"above {WRONG_MM:.0f} mm, of all layouts."), "",
             *table(["scene", "started", "error ratio, all", "seen", "mm, all", "seen", f"all goals, of {len(SEEDS)}",
                     "frames elsewhere"], start_rows(starts)),
             "## Without a pose", "",
             *paragraph("The body has a picture, and is searched in the whole image. Right: it was called TRACKING, and never elsewhere; "
                        "wrong: it was called TRACKING elsewhere."), "",
             *table(["scene", "right", "not found", "wrong"], free_rows(free))]
    return "\n".join(lines).rstrip() + "\n"
