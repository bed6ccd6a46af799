"""Records and tracks the scenes of `make paper`: a scene once with each texture, equal runs once."""
import concurrent.futures
import json
import shutil
import subprocess
import sys
import time
import typing

from evaluation.runs import DEVEL, OUTPUT, ROOT, ToolFailed, object_of, tool, tool_of
from paper_parts.methods import CUT_THROUGH, TEAR

FOLDER = OUTPUT / "paper"
BOARD = "cut_board"  # scene cut; the marked board itself is the blade
BOARD_TOOL = ("--tool", ROOT / "config/board.yaml")
COARSE = "coarse"  # the doll with as many cage vertices as the paper's
COARSE_VERTICES = "128"


class Run(typing.NamedTuple):
    """One scene, tracked with one text of parameters."""

    scene: str
    text: str = ""
    model: str = ""    # empty: the shipped object
    texture: str = ""  # of the recorded body; empty: that of the virtual camera

    @property
    def recorded(self):
        """Which recording it needs: runs with the same one share it."""
        return self.scene, self.texture


def perform(runs, timed, kept, jobs):
    """Reports by run: those of `evaluate`, with more that is read from the result. Runs in `timed` have the machine for
    themselves. The results of runs in `kept` and the recordings stay until clear_bags(); the reports name them.
    """
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    if any(run.model for run in runs):
        tool("prepare_model", ROOT / "config/doll.obj", "--cage-vertices", COARSE_VERTICES, "--output", FOLDER / COARSE,
             package="softbody_sim")
    recordings = recorded(dict.fromkeys(run.recorded for run in runs), jobs)
    say, reports = progress(len(runs)), {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        pending = {pool.submit(measure, number, run, recordings[run.recorded], run in kept): run
                   for number, run in enumerate(runs) if run not in timed}
        for run, report in as_they_end(pool, pending):
            reports[run] = report
            say(run.scene)
    for number, run in enumerate(runs):
        if run in timed:
            reports[run] = measure(number, run, recordings[run.recorded], run in kept)
            say(f"{run.scene}, alone")
    return reports


def as_they_end(pool, pending):
    """(what it is for, its result) of every future. If one fails, those that wait are not begun."""
    try:
        for future in concurrent.futures.as_completed(pending):
            yield pending[future], future.result()
    except ToolFailed:
        pool.shutdown(cancel_futures=True)
        raise


def clear_bags():
    for bag in FOLDER.glob("*.bag"):
        bag.unlink()


def progress(count):
    """A function that says how many of so many runs are done."""
    start, done = time.monotonic(), []

    def say(words):
        done.append(words)
        print(f"[{len(done)}/{count}, {time.monotonic() - start:.0f} s] {words}", file=sys.stderr, flush=True)

    return say


def recorded(needed, jobs):
    """{(scene, texture): recording}"""
    say = progress(len(needed))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        pending, found = {pool.submit(record, *which): which for which in needed}, {}
        for which, found[which] in as_they_end(pool, pending):
            say(f"{' '.join(filter(None, which))} recorded")
    return found


def record(scene, texture):
    path = FOLDER / f"{'_'.join(filter(None, (scene, texture)))}.bag"
    played = ("cut", *BOARD_TOOL) if scene == BOARD else (scene,)
    tool("virtual_camera", "--scene", *played, *(("--texture", texture) if texture else ()), "--output", path)
    return path


def measure(number, run, recording, keep):
    """The report of one run."""
    name = f"{run.scene}_{number}"
    parameters, result = FOLDER / f"{name}.yaml", FOLDER / f"{name}_result.bag"
    parameters.write_text(run.text)
    config = FOLDER / COARSE / "object.yaml" if run.model else object_of(run.scene)
    knife = BOARD_TOOL if run.scene == BOARD else tool_of(run.scene)
    tool("replay", recording, "--object", config, "--output", result, "--timing", *knife,
         *(("--parameters", parameters) if run.text else ()))
    report = json.loads(tool("evaluate", result, "--truth", recording, "--json"))
    report |= {"recording": str(recording), "result": str(result), **read_by("counts.py", result)}
    if run.scene in CUT_THROUGH:
        report["quality"] = read_by("cut_quality.py", result)
    if run.scene == TEAR:
        report["times"] = read_by("tear_times.py", result, recording)
    (FOLDER / f"{name}.json").write_text(json.dumps(report))
    if not keep:
        result.unlink()
    return report


def peer_runs():
    """{body: {simulator: error and time}}"""
    return json.loads(tool("compare_peers", package="development/softbody_sim"))


def read_by(script, result, *more):
    """What a script of this folder prints about a bag of `replay`."""
    command = [DEVEL / "env.sh", "/usr/bin/python3", ROOT / "scripts/paper_parts" / script, result, *more]
    answer = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if answer.returncode != 0:
        raise ToolFailed(f"{script} {result}\n{answer.stderr}")
    return json.loads(answer.stdout)
