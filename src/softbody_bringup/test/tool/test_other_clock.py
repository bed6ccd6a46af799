"""A camera whose clock is 100 s behind, as on another machine: body and tool are followed, /diagnostics do not take it for
silence, and say that the clocks differ."""
import unittest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from recorder import Recorder

EXPECTED = {"feature_tracker: tracking": (DiagnosticStatus.OK, "tracking"), "tool_tracker: tool": (DiagnosticStatus.OK, "seen"),
            "camera_ingest: frames": (DiagnosticStatus.WARN, "100")}


class OtherClock(unittest.TestCase):
    def test_frames_are_no_silence(self):
        recorder = Recorder(diagnostics=DiagnosticArray)
        for name, (level, words) in EXPECTED.items():
            recorder.wait(lambda seen: any(status.name.endswith(name) and status.level == level
                                           and words in status.message.lower()
                                           for message in seen["diagnostics"] for status in message.status),
                          f"{name} that says {words}")
