"""Camera, injector and marker tell of themselves on /diagnostics, beside the graph, and the aggregator knows them all."""
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from recorder import Recorder

STATUSES = {"virtual_camera: frames": "Virtual camera", "injector: faults": "Injector",
            "softbody/camera_ingest: frames": "Camera", "softbody/camera_ingest: sync offset": "Camera",
            "softbody/feature_tracker: tracking": "Tracking", "softbody/pose_marker: marker": "Pose marker",
            "softbody/simulator: simulation": "Simulation", "softbody/surface: visual mesh": "Surface"}


def values(status):
    return {value.key: value.value for value in status.values}


class Diagnostics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(diagnostics=DiagnosticArray, diagnostics_agg=DiagnosticArray)

    def test_every_node_has_a_status_and_a_group(self):
        for name, group in STATUSES.items():
            self.recorder.wait(lambda seen: any(s.name.strip("/") == name for m in seen["diagnostics"] for s in m.status),
                               f"a status of {name}")
            grouped = f"/softbody/{group}/" + name.replace("/", " ")
            self.recorder.wait(lambda seen: any(s.name == grouped for m in seen["diagnostics_agg"] for s in m.status),
                               f"{grouped} among the groups")

    def test_the_marker_is_shown(self):
        self.recorder.wait_for_status("pose_marker: marker", DiagnosticStatus.OK, "the marker is shown")

    def test_the_injector_counts_what_it_drops(self):
        def drops(status):
            count = values(status)
            return int(count["/camera/color/image_raw, images in"]) > int(count["/camera/color/image_raw, images out"]) > 0
        self.recorder.wait(lambda seen: any(s.name.endswith("injector: faults") and s.level == DiagnosticStatus.OK and drops(s)
                                            for m in seen["diagnostics"] for s in m.status), "dropped images")

    def test_the_camera_has_a_rate(self):
        self.recorder.wait(lambda seen: any(s.name.endswith("virtual_camera: frames")
                                            and float(values(s)["frames per second"]) > 1.0
                                            for m in seen["diagnostics"] for s in m.status), "frames of the camera")
