"""The figures of a measurement, as a dictionary for JSON and for the printed report."""
import os

from live.measurement import AFTER_S
from live.streams import AROUND_S, CAMERA, CUTS, STREAMS, TOOL, gaps

QUANTILES = {"median": 0.5, "p95": 0.95, "p99": 0.99, "worst": 1.0}


def quantiles(values):
    """Nothing of no values."""
    values = sorted(values)
    return {name: values[min(len(values) - 1, int(share * len(values)))] for name, share in QUANTILES.items()} if values else None


def stream_figures(measurement, topic):
    begin, end, rate = measurement.begin, measurement.end, measurement.options.rate
    stream = measurement.streams[topic]
    frames = [stamp for stamp, _ in measurement.streams[CAMERA].between(begin, end)]
    cuts = [stamp for stamp, _ in measurement.streams[CUTS].between(begin, end)]
    due = measurement.knife.shown.intersection(frames) if topic == TOOL else set(frames)
    result = {"messages": len(stream.between(begin, end)), "due": len(due)}
    if not result["messages"]:
        return result
    answers = stream.between(begin, end + AFTER_S)
    result["answered"] = len(due.intersection(stamp for stamp, _ in answers))
    result["gaps"] = [gaps(answers, frames, due, near, begin, end, rate) for near in ([[], cuts] if cuts else [[]])]
    if topic != CAMERA:
        # When each image was published. The stamps of a bag are old: there the arrival of the CameraInfo counts.
        camera = measurement.streams[CAMERA]
        published = dict(zip(camera.stamps, camera.clock if measurement.options.bag else camera.stamps))
        result["latency_ms"] = quantiles(
            1e3 * (now - published[stamp]) for stamp, arrival, now in zip(stream.stamps, stream.arrivals, stream.clock)
            if begin <= arrival < end and stamp in published)
    return result


def cpu_figures(measurement, frames):
    """Per frame [ms], and the number of cores."""
    times, seconds = dict(measurement.times), measurement.end - measurement.begin
    camera = times.pop("play" if measurement.options.bag else "virtual_camera", 0.0)
    graph = sum(times.values())
    return {"nodes_ms": {row: 1e3 * time / frames for row, time in times.items()},
            "graph_ms": 1e3 * graph / frames, "graph_cores": graph / seconds,
            "camera_ms": 1e3 * camera / frames, "camera_cores": camera / seconds}


def complaint(measurement, streams):
    """A sentence about missing messages, or None."""
    options, begin, end = measurement.options, measurement.begin, measurement.end
    silent = [topic for topic, figures in streams.items() if not figures["messages"] and figures["due"]]
    if silent:
        return f"silent while messages were due: {', '.join(silent)}"
    cuts = measurement.streams[CUTS]
    if not options.cuts or cuts.between(begin, end):
        return None
    counted = f"scene {options.scene} has a cut, but no message came on {CUTS} in the measured {end - begin:.1f} s"
    early = [begin - arrival for arrival in cuts.arrivals if arrival < begin]
    if early:
        return f"{counted}. It came {early[-1]:.1f} s before, while the graph was still starting"
    return f"{counted}. Try a longer --seconds"


def figures_of(measurement):
    options, seconds = measurement.options, measurement.end - measurement.begin
    streams = {topic: stream_figures(measurement, topic) for topic in [CAMERA, *STREAMS]
               if options.cuts or topic != TOOL}
    frames = streams[CAMERA]["messages"]
    return {"source": options.bag or "scene " + options.scene, "is_bag": bool(options.bag), "cores": os.cpu_count(), "load": measurement.load,
            "seconds": seconds, "frames": frames, "cuts": len(measurement.streams[CUTS].between(measurement.begin, measurement.end)),
            "streams": streams, "cpu": cpu_figures(measurement, frames), "complaint": complaint(measurement, streams)}


def print_figures(figures):
    streams, seconds, cpu = figures["streams"], figures["seconds"], figures["cpu"]
    print(f"{figures['source']}, {seconds:.1f} s; {figures['cores']} cores, load average {figures['load']:.1f}")
    near = f"; {figures['cuts']} cuts, within {AROUND_S:g} s of one:" if figures["cuts"] else ""
    print(f"  {'':32}   rate  messages  longest gap{near}")
    for topic, stream in streams.items():
        if not stream["messages"]:
            print(f"  {topic:32}  silent")
            continue
        print(f"  {topic:32} {stream['messages'] / seconds:4.1f} Hz  {stream['messages']:8}  " +
              "    ".join(f"{in_frames:3} frames {in_ms:6.1f} ms" for in_frames, in_ms in stream["gaps"]))
        if topic == TOOL and stream["due"] < figures["frames"]:
            print(f"  {'':32}   (no message is due in the {figures['frames'] - stream['due']} of {figures['frames']} frames in which no "
                  "marker is in the image)")
    print(f"  {'latency since the image [ms]':32} median     p95     p99   worst")
    for topic, stream in streams.items():
        if stream.get("latency_ms"):
            print(f"  {topic:32}" + " ".join(f"{value:7.1f}" for value in stream["latency_ms"].values()))
    print(f"  {'CPU time per frame [ms]':32}")
    for row, milliseconds in sorted(cpu["nodes_ms"].items(), key=lambda item: -item[1]):
        if milliseconds >= 0.05:
            print(f"  {row:32}{milliseconds:7.1f}")
    print(f"  {'graph without the camera':32}{cpu['graph_ms']:7.1f}   ({cpu['graph_cores']:.2f} cores)")
    if not figures["is_bag"]:
        print(f"  {'camera':32}{cpu['camera_ms']:7.1f}   ({cpu['camera_cores']:.2f} cores)")
