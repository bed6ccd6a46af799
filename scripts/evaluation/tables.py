"""The rows of the tables in docs/evaluation.md, from the reports of `evaluate`."""
import statistics

from evaluation.figures import (FALSE_AFTER_S, MEANS, OWN_COLOUR, P95, PLAIN, TEXTURED, TEXTURES, WRONG_MATCH_SEEDS,
                                answered, calibration_bins, false_tracking, frames_of, get, of_kind, ratio,
                                tracking_share, value_of, worst)
from evaluation.runs import object_of
from pages import ROOT, number, percent
from plots import log_plot


def numbers(report, *paths):
    return [number(get(report, path)) for path in paths]


def beside(reports, kinds, name, *paths):
    """Each value of a scene, for all kinds of runs."""
    return [number(value_of(reports, kind, name, path)) for path in paths for kind in kinds]


def tracked(report):
    """Cells: how many frames have an answer, and the share of those called TRACKING."""
    return [answered(report), percent(tracking_share(report), 0)]


def accuracy(reports):
    return [[name, *tracked(report),
             *numbers(report, *(f"vertex_error.all.{key}_mm" for key in ("mean", "rms", "p95", "max")), *MEANS[1:]),
             *(percent(get(report, path)) for path in ("silhouette.mean_iou", "labels.right", "volume.largest_error"))]
            for name, report in of_kind(reports, "scene").items()]


def noise(reports):
    return [[name, *beside(reports, ("noise off", "scene"), name, MEANS[1], MEANS[2], P95)]
            for name in of_kind(reports, "noise off")]


def volumes(reports):
    return [[name, *beside(reports, ("scene", "exact", "fine", "fine exact"), name, P95, MEANS[2])]
            for name in of_kind(reports, "exact")]


def cluttered(reports):
    return [[name, *tracked(report),
             *(cell for part in ("all", "visible") for cell in
               (*beside(reports, ("uncluttered", "cluttered"), name, f"vertex_error.{part}.mean_mm"),
                number(ratio(reports, ("cluttered", name), ("uncluttered", name), part))))]
            for name, report in of_kind(reports, "cluttered").items()]


def moving_camera(reports):
    for name, moving in of_kind(reports, "moving camera").items():
        cells = beside(reports, ("scene", "moving camera"), name, MEANS[0], P95, MEANS[1], "jitter.per_vertex.rms_mm")
        times = ratio(reports, ("moving camera", name), ("scene", name))
        yield [name, answered(moving), *cells[:2], number(times), *cells[2:]]


def long_runs(reports):
    return [[name, answered(report), *numbers(report, MEANS[0]), number(get(report, "vertex_error.drift_mm"), 3),
             *numbers(report, "vertex_error.drift_ratio"), number(get(report, "jitter.per_vertex.rms_mm"), 3)]
            for name, report in of_kind(reports, "long").items()]


def forces(reports):
    found = {name: report["forces"] for name, report in of_kind(reports, "scene").items() if "forces" in report}
    return [[name, number(forces["frames"], 0), *numbers(forces, "mean_n", "p95_n"), percent(forces["right"]),
             *numbers(forces, "place.mean_mm", "place.p95_mm"), percent(forces["within_90"])]
            for name, forces in found.items()]


def absences(reports):
    return [[name, f"{absence['begin_s']:.1f} to {absence['end_s']:.1f}", percent(absence["covered_share"], 0),
             *numbers(absence, "covered.mean_mm", "normal_mm"),
             *("never" if absence[key] is None else number(absence[key])
               for key in ("recovery_s", "recovery_to_before_s"))]
            for name, report in of_kind(reports, "scene").items() for absence in report.get("absences", [])]


def cuts(reports):
    for name, report in of_kind(reports, "scene").items():
        if "cut_surface" not in report:
            continue
        pieces, tool = report["pieces"], report.get("tool")
        yield [name, f"{pieces['result_pieces']} of {pieces['true_pieces']}", percent(pieces["frames_right"]),
               percent(pieces["vertices_right"]), number(pieces["delay_s"]),
               ", ".join(number(piece["mean_mm"]) for piece in report["vertex_error"]["pieces"]) or "-",
               *numbers(report, "vertex_error.near_cut.mean_mm", "cut_surface.distance.mean_mm"),
               number(worst(get(report, f"cut_surface.{way}.max_mm") for way in ("distance", "missed"))),
               *numbers(report, "cut_surface.tilt_deg"), percent(get(report, "volume.cut_change"), 3),
               f"{tool['answered']} of {tool['expected']}" if tool else "-",
               *numbers(tool, "position.mean_mm", "rotation_deg.mean")]


def open_loop(reports):
    return [[name, percent(tracking_share(report), 0), *numbers(report, MEANS[0]),
             number(report["vertex_error"]["frame_mean_mm"][-1]), number(get(report, "open_loop.duration_s"), 1),
             *numbers(report, *(f"open_loop.all.{key}_mm" for key in ("mean", "p95", "max")), "open_loop.last_mean_mm")]
            for name, report in of_kind(reports, "open loop").items()]


def faults(reports):
    for scene in (name for name in WRONG_MATCH_SEEDS if ("scene", name) in reports):
        faulty = {key[1][1]: key for key in reports if key[0] == "fault" and key[1][0] == scene}
        for fault, key in {"none": ("scene", scene), **faulty}.items():
            report = reports[key]
            yield [scene, fault, f"{report['frames']['answered']} of {report['frames'].get('recorded', '-')}",
                   percent(tracking_share(report), 0), *numbers(report, MEANS[0]),
                   number(ratio(reports, key, ("scene", scene))), *numbers(report, P95)]


def stage_times(reports):
    """Median over the scenes of a body of the stage's median time in a frame."""
    times = {}
    for name, report in of_kind(reports, "scene").items():
        for stage in report.get("stages", []):
            words = stage["stage"] + (" (initialization)" if stage["initialization"] else "")
            times.setdefault(words, {}).setdefault(object_of(name).stem, []).append(stage["median_ms"])
    return [[words, *(number(statistics.median(of_body[body]) if body in of_body else None)
                      for body in ("sponge", "doll"))]
            for words, of_body in times.items()]


def toys(reports):
    rows = []
    for kind, words in (("toys", ""), ("no pose", ", without a rough pose")):
        found = value_of(reports, kind, "toys", "depth_residual") or {"windows": [], "all": None}
        for window in (*found["windows"], found["all"]) if kind == "toys" else [found["all"]]:
            if window:
                first, count = window["first_frame"], window["frames"]
                rows.append([f"{first} to {first + count - 1}{words}", number(window["answered"], 0),
                             *numbers(window, "residual.median_mm", "residual.p95_mm"),
                             percent(window["within_10mm"]), percent(window["within_15mm_of_measured"])])
    return rows or [["skipped: ../shared/data/toys is missing", *["-"] * 5]]


def plain_bodies(reports):
    return [[name, *tracked(report), *numbers(report, *MEANS), number(max(frame.mean for frame in frames_of(report))),
             *numbers(report, "jitter.per_vertex.rms_mm"), *beside(reports, ("starts",), name, "mean_mm", "max_mm")]
            for name, report in of_kind(reports, "plain").items() if name in (*PLAIN, *OWN_COLOUR)]


def textures(reports):
    kinds = ("scene", *TEXTURES)
    return [[scene, *beside(reports, kinds, scene, *MEANS[1:])] for scene in TEXTURED
            if any((kind, scene) in reports for kind in TEXTURES)]


def predicted_errors(reports):
    words = {"scene": "", "plain": ", one colour", "weak": ", weak texture"}
    return [[name + words[kind],
             *(percent(get(report, f"calibration.within_90_{part}")) for part in ("visible", "hidden")),
             *numbers(report, "calibration.median_ratio")]
            for kind in words for name, report in of_kind(reports, kind).items()]


def wrong_objects(reports):
    for what, report in of_kind(reports, "wrong").items():
        late = [state for time, state in report["states_by_time"] if time >= FALSE_AFTER_S]
        yield [what, late[0], f"{false_tracking(report)} of {len(late)}", "-"]
    for what, report in of_kind(reports, "placed").items():
        late = [frame for frame in frames_of(report) if frame.since >= FALSE_AFTER_S]
        yield [what, late[0].state, f"{sum(frame.state == 'tracking' for frame in late)} of {len(late)}",
               number(max(frame.visible_most for frame in late if frame.visible_most is not None))]


def plot_calibration(reports):
    """RMS error over predicted standard deviation; nothing without predictions."""
    bins = calibration_bins(reports)
    if bins:
        log_plot(ROOT / "docs/images/calibration.svg", ("predicted standard deviation [mm]", "RMS error [mm]"),
                 [("each bin of predictions", bins, {"marker": "o", "linestyle": ""}),
                  ("as predicted", [(0.01, 0.01), (100.0, 100.0)], {"color": "#888"})], size=(6.5, 4.5))
