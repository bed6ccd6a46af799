"""The rows of the tables in docs/scans.md, from the results of scans.py; the page repeats these limits."""
import re

from evaluation.figures import get, tracking_share
from pages import number, percent

# Seen surface, mean and 99 % [mm], with the camera's motion known by the sheet or tf, and without.
KNOWN_MM, FREE_MM = (0.5, 2.0), (0.8, 3.0)
CLOSED_FLAT, TURNED_OVER = 0.05, 0.02  # of the volume
SECONDS, MEMORY_GB = 60.0, 2.0  # of each recording; of all
WRONG_MM, WRONG_VOLUME, WRONG_UNSEEN_VOLUME = 0.8, 0.05, 0.1
LARGER_ERROR = 1.2  # of tracking, scanned over true mesh
MOST_SEEN = 90  # [%] of what does not lie on the table; with less, a part was not seen


def seen(result):
    """Distance of the seen surface to the true one: mean and 99 % [mm]."""
    distance = result["report"]["seen"]["scanned_to_true"]
    return distance["mean_mm"], distance["p99_mm"]


def volume_error(result):
    return abs(result["report"]["volume_ratio"] - 1.0)


def missed(row, result):
    """The goals that a model misses."""
    mean, most = KNOWN_MM if row.known_motion else FREE_MM
    volume = TURNED_OVER if len(row.recordings) > 1 else CLOSED_FLAT
    seconds = min(result["seconds"], result["cpu_seconds"])
    checks = {"mean": seen(result)[0] <= mean, "99 %": seen(result)[1] <= most,
              "volume": volume_error(result) <= volume, "time": seconds <= SECONDS * len(row.recordings),
              "memory": result["memory_gb"] <= MEMORY_GB}
    return [name for name, reached in checks.items() if not reached]


def wrong(result):
    share = re.search(r"(\d+) % of what did not lie", result["text"])
    unseen = share and int(share[1]) < MOST_SEEN
    return seen(result)[0] > WRONG_MM or volume_error(result) > (WRONG_UNSEEN_VOLUME if unseen else WRONG_VOLUME)


def figures(result):
    report = result["report"]
    complete = report["whole"]["complete_within_2mm"]
    return [*map(number, seen(result)), number(report["volume_ratio"], 3), percent(complete)]


def refusal(row, result):
    """Why there is no model: the tool's last line, without the folder of the recording."""
    lines = result["text"].strip().splitlines() or ["it said nothing"]
    sentence = lines[-1].removeprefix("scan_model: ").replace(f"{row.recordings[0].path.parent}/", "")
    return f"{'no model' if result['code'] == 1 else 'CRASH'}: {sentence}"


def cost(result):
    return [f"{result['seconds']:.0f}", f"{result['cpu_seconds']:.0f}", f"{result['memory_gb']:.1f}"]


def good_row(row, result):
    if "report" not in result:
        return [f"`{row.name}`", row.words, *4 * ["-"], *cost(result), refusal(row, result), result["commit"]]
    misses = missed(row, result)
    reached = "no: " + ", ".join(misses) if misses else "yes"
    return [f"`{row.name}`", row.words, *figures(result), *cost(result), reached, result["commit"]]


def faulty_row(row, result):
    if "report" not in result:
        return [f"`{row.name}`", row.words, *4 * ["-"], refusal(row, result), result["commit"]]
    answer = "WRONG model" if wrong(result) else "right model"
    return [f"`{row.name}`", row.words, *figures(result), answer, result["commit"]]


def visible(report, metric):
    return report[metric]["visible"]["mean_mm"]


def tracking_rows(scene, result):
    """A row for each scanned model."""
    rows, true = [], result["true"]
    for model, report in result["scanned"].items():
        pairs = [(visible(true, metric), visible(report, metric)) for metric in ("surface_distance", "vertex_error")]
        cells = [number(value) for one, other in pairs for value in (one, other, other / one)]
        bounds = [percent(get(one, "calibration.within_90_visible"), 0) for one in (true, report)]
        share = tracking_share(report)
        misses = {"error": pairs[0][1] > LARGER_ERROR * pairs[0][0], "tracked": share < tracking_share(true)}
        missed_goals = [name for name, is_missed in misses.items() if is_missed]
        rows.append([f"`{scene.name}`", scene.words, f"`{model}`", percent(share, 0), *cells, *bounds,
                     "no: " + ", ".join(missed_goals) if missed_goals else "yes", result["commit"]])
    return rows


def rows_of(row, result):
    if "true" in result:
        return tracking_rows(row, result)
    return [(faulty_row if row.name.startswith("fault_") else good_row)(row, result)]
