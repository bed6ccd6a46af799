"""The tables of docs/evaluation.md, and the short one in README.md, from the reports of `evaluate`."""
import datetime
import math
import statistics
import subprocess

BEGIN, END = "<!-- evaluation begin: written by make evaluate -->", "<!-- evaluation end -->"
NOISE_FREE = ("bend", "push", "pull", "twist", "press")
MOVING = ("still", "bend", "push", "twist")
# Scenes with faults. One draw of wrong matches says little: the error differs by a third between them.
WRONG_MATCH_SEEDS = {"bend": (1, 2, 3, 4), "push": (1, 2), "twist": (1, 2)}
DEPTH_HOLES, FEW_FEATURES = "30 % depth holes", "50 features instead of 1000"


def wrong_matches(seed):
    return f"20 % wrong matches, seed {seed}"


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def percent(value, digits=1):
    return "-" if value is None else f"{100.0 * value:.{digits}f}"


def get(report, *keys):
    """A value deep in a report; None where there is none."""
    for key in keys:
        if report is None:
            return None
        report = report.get(key) if isinstance(report, dict) else None
    return report


def of_kind(reports, kind):
    """Reports of one kind by name, in alphabetical order; those of other bodies after the sponge's."""
    chosen = {name: report for (its_kind, name), report in reports.items() if its_kind == kind}
    return dict(sorted(chosen.items(), key=lambda item: ("_" in item[0], item[0])))


def frames(report):
    return f"{report['frames']['answered']} of {report['frames']['expected']}"


def tracking_share(report):
    states = report.get("states", {})
    return states.get("tracking", 0) / sum(states.values()) if states else None


def worst(values):
    """The largest; None if one was not measured."""
    values = list(values)
    return max(values) if values and all(value is not None for value in values) else None


def table(columns, rows):
    lines = [columns, ["---"] * len(columns), *rows]
    return ["| " + " | ".join(cells) + " |" for cells in lines] + [""]


def section(title, words, columns, rows):
    """A table with its words; nothing where there is no row."""
    return [f"## {title}", "", words, "", *table(columns, rows)] if rows else []


def accuracy(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        error = report["vertex_error"]
        lengths = [error["all"][key] for key in ("mean_mm", "rms_mm", "p95_mm", "max_mm")]
        rows.append([name, frames(report), percent(tracking_share(report), 0), *map(number, lengths),
                     number(error["visible"]["mean_mm"]), number(error["hidden"]["mean_mm"]),
                     percent(get(report, "silhouette", "mean_iou")), percent(get(report, "volume", "largest_error"))])
    return section("Every scene", "Distance of all vertices in all answered frames to where they truly are [mm].",
                   ["scene", "frames answered", "tracking [%]", "mean", "RMS", "p95", "max", "mean visible",
                    "mean hidden", "silhouette IoU [%]", "volume error at most [%]"], rows)


def noise(reports):
    rows = []
    for name, off in of_kind(reports, "noise off").items():
        on = reports.get(("scene", name))
        cells = [number(get(report, "vertex_error", part, key)) for part, key in
                 (("visible", "mean_mm"), ("hidden", "mean_mm"), ("all", "p95_mm")) for report in (off, on)]
        rows.append([name, *cells])
    return section("With and without noise", "[mm]",
                   ["scene", "mean visible, off", "on", "mean hidden, off", "on", "p95, off", "on"], rows)


def volumes(reports):
    rows = []
    for name in of_kind(reports, "exact"):
        cells = [number(get(reports.get((kind, name)), "vertex_error", *keys)) for keys in
                 (("all", "p95_mm"), ("hidden", "mean_mm")) for kind in ("scene", "exact", "fine", "fine exact")]
        rows.append([name, *cells])
    return section("What the volume allows",
                   "Tracked, and simulated with every visible vertex where it truly is (`simulate_truth`), with the paper's\n"
                   "300 tets and with those of a cage of 300 vertices (`prepare_model --cage-vertices 300`) [mm].",
                   ["scene", "p95, tracked", "exact", "finer, tracked", "finer, exact", "mean hidden, tracked", "exact",
                    "finer, tracked", "finer, exact"], rows)


def moving_times(reports):
    """Mean errors before a camera that moves as multiples of those before one at rest, by scene."""
    keys = ("vertex_error", "all", "mean_mm")
    return {name: get(moving, *keys) / get(reports[("scene", name)], *keys)
            for name, moving in of_kind(reports, "moving camera").items()}


def moving_camera(reports):
    rows, times = [], moving_times(reports)
    for name, moving in of_kind(reports, "moving camera").items():
        rest = reports.get(("scene", name))
        cells = [number(get(report, *keys)) for keys in
                 (("vertex_error", "all", "mean_mm"), ("vertex_error", "all", "p95_mm"),
                  ("vertex_error", "visible", "mean_mm"), ("jitter", "per_vertex", "rms_mm"))
                 for report in (rest, moving)]
        rows.append([name, frames(moving), *cells[:2], number(times[name]), *cells[2:]])
    return section("A camera that moves", "`--camera-motion orbit`, tracked with `--output-frame world` [mm].",
                   ["scene", "frames answered", "mean, at rest", "moving", "times", "p95, at rest", "moving",
                    "mean visible, at rest", "moving", "jitter while still, at rest", "moving"], rows)


def long_runs(reports):
    rows = []
    for name, report in of_kind(reports, "long").items():
        error = report["vertex_error"]
        rows.append([name, frames(report), number(error["all"]["mean_mm"]), number(error["drift_mm"], 3),
                     number(error["drift_ratio"]), number(get(report, "jitter", "per_vertex", "rms_mm"), 3)])
    return section("Over a minute", "Drift is the mean error of the last five seconds against that of the first five.",
                   ["scene", "frames answered", "mean [mm]", "drift [mm]", "drift [times]",
                    "jitter while still [mm RMS]"], rows)


def absences(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        for absence in report.get("absences", []):
            recoveries = [absence[key] for key in ("recovery_s", "recovery_to_before_s")]
            rows.append([name, f"{absence['begin_s']:.1f} to {absence['end_s']:.1f}",
                         percent(absence["covered_share"], 0), number(absence["covered"]["mean_mm"]),
                         number(absence["normal_mm"]),
                         *("never" if seconds is None else number(seconds) for seconds in recoveries)])
    return section("Hidden and back", "More than a quarter of what the camera saw at first is hidden, or out of view. "
                   "Normal is, in the scenes `occlude`, the\nerror of the same frame where the same motion is followed "
                   "without the hand; in the others, and for all in the last\ncolumn, the p95 of the frames before. "
                   "Back is an error of at most 1.2 times that.",
                   ["scene", "from, to [s]", "hidden at most [%]", "mean error of the hidden part [mm]",
                    "normal error [mm]", "back to normal after [s]", "back to the error before after [s]"], rows)


def cuts(reports):
    rows = []
    for name, report in of_kind(reports, "scene").items():
        cut, pieces, tool = report.get("cut_surface"), report.get("pieces"), report.get("tool")
        if cut is None:
            continue
        error = report["vertex_error"]
        rows.append([name, f"{pieces['result_pieces']} of {pieces['true_pieces']}", percent(pieces["frames_right"]),
                     percent(pieces["vertices_right"]),
                     ", ".join(number(piece["mean_mm"]) for piece in error["pieces"]) or "-",
                     number(error["near_cut"]["mean_mm"]), number(cut["distance"]["mean_mm"]),
                     number(worst([cut["distance"]["max_mm"], cut["missed"]["max_mm"]])), number(cut["tilt_deg"]),
                     percent(get(report, "volume", "cut_change"), 3),
                     f"{tool['answered']} of {tool['expected']}" if tool else "-",
                     number(get(tool, "position", "mean_mm")), number(get(tool, "rotation_deg", "mean"))])
    return section("Cuts", "Errors of the pieces and near the cut, and of the cut's surface in the rest body [mm].",
                   ["scene", "pieces at the end", "frames with the right number [%]", "vertices in the right piece [%]",
                    "mean error by piece", "near the cut", "cut surface, mean", "at most", "tilt [deg]",
                    "volume changed by cuts [%]", "tool poses", "tool position [mm]", "tool angle [deg]"], rows)


def fault_times(reports, scene, fault):
    """Mean error with a fault as a multiple of that without; None if one was not measured."""
    base, faulty = (get(reports.get(key), "vertex_error", "all", "mean_mm")
                    for key in (("scene", scene), ("fault", (scene, fault))))
    return None if base is None or faulty is None else faulty / base


def faults(reports):
    rows = []
    for scene in (name for name in WRONG_MATCH_SEEDS if ("scene", name) in reports):
        plain = reports[("scene", scene)]
        faulty = {name[1]: report for (kind, name), report in reports.items() if kind == "fault" and name[0] == scene}
        for fault, report in {"none": plain, **faulty}.items():
            error = report["vertex_error"]["all"]
            times = 1.0 if report is plain else fault_times(reports, scene, fault)
            rows.append([scene, fault, f"{report['frames']['answered']} of {report['frames'].get('recorded', '-')}",
                         percent(tracking_share(report), 0), number(error["mean_mm"]), number(times),
                         number(error["p95_mm"])])
    return section("Faults", "What `inject` puts into a scene's recording, and other parameters.",
                   ["scene", "fault", "recorded frames answered", "tracking [%]", "mean [mm]", "times the error without",
                    "p95 [mm]"], rows)


def stage_times(reports):
    """Medians over the scenes of an object."""
    times = {}
    for name, report in of_kind(reports, "scene").items():
        body = name.rsplit("_", 1)[0] if "_" in name else "sponge"
        for stage in report.get("stages", []):
            words = stage["stage"] + (" (first frame)" if stage["initialization"] else "")
            times.setdefault(words, {}).setdefault(body, []).append(stage["median_ms"])
    bodies = sorted({body for of_body in times.values() for body in of_body},
                    key=lambda body: (body != "sponge", body))
    rows = [[words, *(number(statistics.median(of_body[body])) if body in of_body else "-" for body in bodies)]
            for words, of_body in times.items()]
    return section("Time", "Median of a stage's time a frame [ms], two replays side by side on this machine.",
                   ["stage", *bodies], rows)


def toys(reports):
    report = reports.get(("toys", "toys"))
    if report is None:  # not asked for
        return []
    if not report:
        return ["## A recorded plush toy", "", "Skipped: no ../shared/data/toys.", ""]
    rows = []
    for window in [*report["depth_residual"]["windows"], report["depth_residual"]["all"]]:
        first, count = window["first_frame"], window["frames"]
        rows.append([f"{first} to {first + count - 1}", str(window["answered"]),
                     number(window["residual"]["median_mm"]), number(window["residual"]["p95_mm"]),
                     percent(window["within_10mm"]),
                     percent(window["within_15mm_of_measured"])])
    return section("A recorded plush toy", "Depth against the tracked surface; there is no other truth.",
                   ["frames", "answered", "median [mm]", "p95 [mm]", "within 10 mm [%]",
                    "within 15 mm, occluded counted as misses [%]"], rows)


def goals(reports):
    """(figure, goal, unit, value): reached if the value is at most, or for a goal with >= at least, the goal."""
    def scene(name, *keys):
        return get(reports.get(("scene", name)), *keys)

    def of(kind, *keys):
        return worst(get(reports.get((kind, name)), "vertex_error", *keys) for name in NOISE_FREE)

    def fault(name):
        return worst(fault_times(reports, scene_name, name) for scene_name in WRONG_MATCH_SEEDS)

    def absence(name, *keys):
        found = scene(name, "absences")
        return get(found[0], *keys) if found else None

    def recovery(name):
        """Seconds; infinite: never."""
        if absence(name, "end_s") is None:
            return None
        seconds = absence(name, "recovery_s")
        return math.inf if seconds is None else seconds

    toy = get(reports.get(("toys", "toys")), "depth_residual", "all")
    pieces = [piece["mean_mm"] for piece in scene("cut", "vertex_error", "pieces") or []]
    sponge, faulty = ", ".join(NOISE_FREE), ", ".join(WRONG_MATCH_SEEDS)
    seeds = ", ".join(f"{name} ({len(drawn)} seeds)" for name, drawn in WRONG_MATCH_SEEDS.items())
    return [
        (f"{sponge}: visible vertices, worst mean, noise off", "<= 0.5", "mm", of("noise off", "visible", "mean_mm")),
        ("the same, noise on", "<= 1.0", "mm", of("scene", "visible", "mean_mm")),
        (f"{sponge}: hidden vertices, worst mean", "<= 2.0", "mm", of("scene", "hidden", "mean_mm")),
        *((f"{name}: all vertices, p95", "<= 3.0", "mm", scene(name, "vertex_error", "all", "p95_mm"))
          for name in NOISE_FREE),
        ("bend for 60 s: last against first five seconds", "<= 1.1", "times",
         get(reports.get(("long", "bend")), "vertex_error", "drift_ratio")),
        ("still: jitter, RMS", "<= 0.2", "mm", scene("still", "jitter", "per_vertex", "rms_mm")),
        ("occlude: hidden part meanwhile", "<= 4.0", "mm", absence("occlude", "covered", "mean_mm")),
        ("occlude: back to 1.2 times the error of the same motion unhidden after", "<= 0.3", "s", recovery("occlude")),
        ("leave: back to 1.2 times the error before after", "<= 1.0", "s", recovery("leave")),
        ("shake: frames followed, mean error up to 10 mm", ">= 100", "%", followed(reports.get(("scene", "shake")))),
        (f"{DEPTH_HOLES}, worst of {faulty}: error", "<= 1.2", "times", fault(DEPTH_HOLES)),
        (f"20 % wrong matches, worst of {seeds}: error", "<= 1.2", "times",
         worst(fault_times(reports, name, wrong_matches(seed))
               for name, drawn in WRONG_MATCH_SEEDS.items() for seed in drawn)),
        (f"{FEW_FEATURES}, worst of {faulty}: error", "<= 1.2", "times", fault(FEW_FEATURES)),
        (f"a camera that moves, worst of {', '.join(MOVING)}: error", "<= 1.2", "times",
         worst(moving_times(reports).get(name) for name in MOVING)),
        ("cut: surface from the true one and back, at most", "<= 2.0", "mm",
         worst(scene("cut", "cut_surface", way, "max_mm") for way in ("distance", "missed"))),
        ("cut: tilt of the surface", "<= 2.0", "deg", scene("cut", "cut_surface", "tilt_deg")),
        ("cut: worse piece, mean", "<= 2.5", "mm", worst(pieces)),
        ("recorded toy: depth residual, median", "<= 4.0", "mm", get(toy, "residual", "median_mm")),
        ("recorded toy: within 10 mm", ">= 90", "%", None if toy is None else 100.0 * toy["within_10mm"]),
    ]


def followed(report):
    """Share of the frames, unanswered ones among them; whatever the tracker says of itself."""
    means = get(report, "vertex_error", "frame_mean_mm")
    return None if means is None else 100.0 * sum(mean <= 10.0 for mean in means) / report["frames"]["expected"]


def goal_table(reports):
    rows = []
    for figure, goal, unit, value in goals(reports):
        relation, limit = goal.split()
        reached = value is not None and (value <= float(limit) if relation == "<=" else value >= float(limit))
        measured = "never" if value == math.inf else number(value)
        rows.append([figure, f"{goal} {unit}", measured, "-" if value is None else "yes" if reached else "no"])
    return table(["figure", "goal", "measured", "reached"], rows)


def in_words(reports):
    """One line on what has been measured."""
    words = []
    for (kind, name), report in reports.items():
        if not report:
            continue
        error = get(report, "vertex_error", "all", "mean_mm")
        what = f"{name[1]}: " if kind == "fault" else ""
        words.append(f"{what}{number(error)} mm" if error is not None else
                     f"{number(report['depth_residual']['all']['residual']['median_mm'])} mm median depth residual")
    return "; ".join(words) or "skipped"


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
