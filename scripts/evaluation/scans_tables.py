"""docs/scans.md, from the results of scans.py."""
import datetime
import re

from evaluation.figures import get, number, percent
from markdown_lines import paragraph, table

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
    checks = {"mean": seen(result)[0] <= mean, "99 %": seen(result)[1] <= most, "volume": volume_error(result) <= volume,
              "time": seconds <= SECONDS * len(row.recordings), "memory": result["memory_gb"] <= MEMORY_GB}
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


COLUMNS = ["row", "recording", "mean [mm]", "99 % [mm]", "volume", "complete [%]"]


TRACKING_COLUMNS = ["row", "scene", "model", "tracked [%]", "true mesh [mm]", "scanned [mm]", "ratio",
                    "vertices, true mesh [mm]", "vertices, scanned [mm]", "ratio", "in bound, true mesh [%]",
                    "in bound, scanned [%]", "goal reached", "commit"]


def visible(report, figure):
    return report[figure]["visible"]["mean_mm"]


def tracked_percent(report):
    return 100 * report["states"].get("tracking", 0) / sum(report["states"].values())


def tracking_rows(scene, result):
    """A row for each scanned model."""
    rows, true = [], result["true"]
    for model, report in result["scanned"].items():
        pairs = [(visible(true, figure), visible(report, figure)) for figure in ("surface_distance", "vertex_error")]
        cells = [number(value) for one, other in pairs for value in (one, other, other / one)]
        bounds = [percent(get(one, "calibration", "within_90_visible"), 0) for one in (true, report)]
        misses = {"error": pairs[0][1] > LARGER_ERROR * pairs[0][0],
                  "tracked": tracked_percent(report) < tracked_percent(true)}
        missed_goals = [name for name, is_missed in misses.items() if is_missed]
        rows.append([f"`{scene.name}`", scene.words, f"`{model}`", f"{tracked_percent(report):.0f}", *cells, *bounds,
                     "no: " + ", ".join(missed_goals) if missed_goals else "yes", result["commit"]])
    return rows


def tracking_part(tracking):
    surface, other = "distance-from-the-true-surface-with-a-truth", "a-result-of-another-mesh"
    return ["## Tracking with the scanned model", "",
            *paragraph("`replay` with its default settings tracks a scene twice: with the shipped true mesh, from its rough "
                       "pose, and with a model of the first table, which is searched for. Error: mean distance of the result "
                       f"from the true surface where the camera sees it ([surface distance](metrics.md#{surface})). It is "
                       "measured in the same way for every mesh, but it does not see that a surface slides along itself. The "
                       "error of the scan itself is a part of it (first table). Vertices: mean error of the visible "
                       "vertices, which sees sliding; a scanned mesh has [other vertices](metrics.md#" + other + "). "
                       "In bound: share of them within their predicted 90 % bound; with less than 90 % the predicted errors "
                       "are too small. Tracked: share of the frames, with the scanned model."), "",
            *paragraph(f"Goals: the error is at most {LARGER_ERROR} times that with the true mesh; as many frames are "
                       "tracked."), "",
            *table(TRACKING_COLUMNS, [row for pair in tracking for row in tracking_rows(*pair)])]


def document(good, faulty, tracking):
    """The page. @param good, faulty, tracking: pairs of row and result."""
    lines = ["# Scans", "", f"Written by `make scans` on {datetime.date.today()}.", "",
             *paragraph("`scan_model` with its default settings makes models from recordings of the virtual camera (20 s at "
                        "30 Hz, 640 x 480), and `evaluate --model` compares them with the true mesh. See [scan an "
                        "object](scanning.md) and the [scenes](virtual_camera.md#scenes). Each row says at which commit it "
                        "was measured."), "",
             *paragraph("Mean, 99 %: distance of the seen surface to the true one. Volume: that of the model over the true "
                        "one. Complete: share of the whole true surface, with the underside, that is nearer than 2 mm to "
                        "the model. Time: of `scan_model`; CPU: user and system time. Other work on the machine makes "
                        "both longer. Memory: the peak."), "",
             "## Recordings", "",
             *paragraph(f"Goals: with the sheet or tf mean <= {KNOWN_MM[0]} mm, 99 % <= {KNOWN_MM[1]:.0f} mm; with neither "
                        f"mean <= {FREE_MM[0]} mm, 99 % <= {FREE_MM[1]:.0f} mm; volume within {100 * TURNED_OVER:.0f} % if the "
                        f"object was turned over, otherwise (it is closed flat) within {100 * CLOSED_FLAT:.0f} %; for each "
                        f"recording time or CPU time <= {SECONDS:.0f} s; memory <= {MEMORY_GB:.0f} GB."), "",
             *table([*COLUMNS, "time [s]", "CPU [s]", "memory [GB]", "goals reached", "commit"],
                    [good_row(*pair) for pair in good]),
             "## Faulty recordings", "",
             *paragraph("A walk round the sponge on the sheet, with a fault. A model is wrong if its seen surface is on the "
                        f"mean more than {WRONG_MM} mm from the true one, or if its volume is off by more than "
                        f"{100 * WRONG_VOLUME:.0f} % ({100 * WRONG_UNSEEN_VOLUME:.0f} % if less than {MOST_SEEN} % of what "
                        "does not lie on the table was seen, which `scan_model` says). No model, and a sentence that says "
                        "what to do, is a good answer."), "",
             *table([*COLUMNS, "answer", "commit"], [faulty_row(*pair) for pair in faulty]),
             *tracking_part(tracking)]
    return "\n".join(lines).rstrip() + "\n"
