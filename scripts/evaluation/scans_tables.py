"""The rows of the tables in docs/measured/scans.md, from the results of scans.py; the page repeats these limits."""
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


def verdict(goals):
    """yes, or no with the goals that are missed."""
    missed = [name for name, reached in goals.items() if not reached]
    return "no: " + ", ".join(missed) if missed else "yes"


def model_verdict(row, result):
    mean, most = KNOWN_MM if row.known_motion else FREE_MM
    volume = TURNED_OVER if len(row.recordings) > 1 else CLOSED_FLAT
    seconds = min(result["seconds"], result["cpu_seconds"])
    return verdict({"mean": seen(result)[0] <= mean, "99 %": seen(result)[1] <= most,
                    "volume": volume_error(result) <= volume, "time": seconds <= SECONDS * len(row.recordings),
                    "memory": result["memory_gb"] <= MEMORY_GB})


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


def model_row(row, result):
    is_faulty = row.name.startswith("fault_")
    cost = [f"{result['seconds']:.0f}", f"{result['cpu_seconds']:.0f}", f"{result['memory_gb']:.1f}"]
    if "report" not in result:
        cells, answer = 4 * ["-"], refusal(row, result)
    elif is_faulty:
        cells, answer = figures(result), "WRONG model" if wrong(result) else "right model"
    else:
        cells, answer = figures(result), model_verdict(row, result)
    return [f"`{row.name}`", row.words, *cells, *([] if is_faulty else cost), answer, result["commit"]]


def visible(report, metric):
    return report[metric]["visible"]["mean_mm"]


def tracking_rows(scene, result):
    """A row for each scanned model."""
    true = result["true"]
    for model, report in result["scanned"].items():
        pairs = [(visible(true, metric), visible(report, metric)) for metric in ("surface_distance", "vertex_error")]
        cells = [number(value) for one, other in pairs for value in (one, other, other / one)]
        bounds = [percent(get(one, "calibration.within_90_visible"), 0) for one in (true, report)]
        share = tracking_share(report)
        goals = {"error": pairs[0][1] <= LARGER_ERROR * pairs[0][0], "tracked": share >= tracking_share(true)}
        yield [f"`{scene.name}`", scene.words, f"`{model}`", percent(share, 0), *cells, *bounds, verdict(goals),
               result["commit"]]


def rows_of(row, result):
    return tracking_rows(row, result) if "true" in result else [model_row(row, result)]
