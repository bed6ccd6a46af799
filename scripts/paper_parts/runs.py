"""Records and tracks the scenes of `make paper`."""
import concurrent.futures
import json
import shutil
import subprocess
import sys

from evaluation.runs import DEVEL, OUTPUT, ROOT, ToolFailed, config_of, measure, tool, tool_of
from paper_parts.methods import CUT_THROUGH, SCENES, TIMED, timed_kinds


def recording_of(scene):
    path = OUTPUT / f"paper_{scene}.bag"
    tool("virtual_camera", "--scene", scene, "--output", path)
    return path


def run(scene, recording, number, text):
    """The report of one scene with one text of parameters."""
    name = f"paper_{scene}_{number}"
    file = OUTPUT / f"{name}.yaml"
    file.write_text(text)
    config, allowed = config_of(scene, name)
    more = ("--parameters", file) if text else ()
    report = measure(name, recording, config, "--truth", recording, more=(*allowed, *more))
    result = OUTPUT / f"{name}_result.bag"
    report["features"] = read_by("feature_counts.py", result)
    result.unlink()
    return report


def accuracy_runs(texts, jobs):
    """Reports by (scene, parameters); equal parameters run once."""
    reports, pending = {}, {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        recordings = dict(zip(SCENES, pool.map(recording_of, SCENES)))
        for scene in SCENES:
            for number, text in enumerate(texts):
                pending[pool.submit(run, scene, recordings[scene], number, text)] = (scene, text)
        for future in concurrent.futures.as_completed(pending):
            reports[pending[future]] = future.result()
            print(f"[{len(reports)}/{len(pending)}] {pending[future][0]}", file=sys.stderr, flush=True)
    for recording in recordings.values():
        recording.unlink()
    return reports


def timed_runs():
    """Reports by (body, kind), one run at a time."""
    reports = {}
    for body, scene in TIMED.items():
        recording = recording_of(scene)
        for kind, text in timed_kinds().items():
            reports[(body, kind)] = run(scene, recording, "time", text)
        recording.unlink()
    return reports


def peer_runs():
    """{body: {simulator: error and time}}"""
    return json.loads(tool("compare_peers", package="development/softbody_sim"))


def cut_runs():
    """Reports of the scenes with a cut through a body, with the shape of the triangles at the cut."""
    reports = {}
    for scene in CUT_THROUGH:
        recording, name = recording_of(scene), f"paper_{scene}"
        config, _ = config_of(scene, name)
        reports[scene] = measure(name, recording, config, "--truth", recording, more=tool_of(scene))
        reports[scene]["quality"] = read_by("cut_quality.py", OUTPUT / f"{name}_result.bag")
        recording.unlink()
        (OUTPUT / f"{name}_result.bag").unlink()
    return reports


def tear_run():
    """The report of scene `tear`, with the times of the tears."""
    recording = recording_of("tear")
    report = measure("paper_tear", recording, ROOT / "config/sponge.yaml", "--truth", recording,
                     more=("--parameters", ROOT / "config/tear.yaml"))
    report["times"] = read_by("tear_times.py", OUTPUT / "paper_tear_result.bag", recording)
    recording.unlink()
    (OUTPUT / "paper_tear_result.bag").unlink()
    return report


def coarse_doll_runs():
    """{scene: report} of the doll with as many cage vertices as the paper's."""
    model, reports = OUTPUT / "paper_coarse_doll", {}
    shutil.rmtree(model, ignore_errors=True)
    tool("prepare_model", ROOT / "config/doll.obj", "--cage-vertices", "128", "--output", model, package="softbody_sim")
    for scene in SCENES:
        if not scene.startswith("doll_"):
            continue
        name, recording = f"paper_coarse_{scene}", recording_of(scene)
        reports[scene] = measure(name, recording, model / "object.yaml", "--truth", recording)
        result = OUTPUT / f"{name}_result.bag"
        reports[scene]["sizes"] = read_by("sizes.py", result)
        recording.unlink()
        result.unlink()
    return reports


def model_sizes():
    """{body: {model: [vertices, polygons]}} from the topologies that the graph publishes."""
    sizes = {}
    for body, scene in TIMED.items():
        recording, result = OUTPUT / f"paper_{body}_model.bag", OUTPUT / f"paper_{body}_model_result.bag"
        tool("virtual_camera", "--scene", scene, "--duration", "0.2", "--output", recording)
        tool("replay", recording, "--object", ROOT / f"config/{body}.yaml", "--output", result)
        sizes[body] = read_by("sizes.py", result)
        recording.unlink()
        result.unlink()
    return sizes


def read_by(script, result, *more):
    """What a script of this folder prints about a bag of `replay`."""
    command = [DEVEL / "env.sh", "/usr/bin/python3", ROOT / "scripts/paper_parts" / script, result, *more]
    answer = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if answer.returncode != 0:
        raise ToolFailed(f"{script} {result}\n{answer.stderr}")
    return json.loads(answer.stdout)
