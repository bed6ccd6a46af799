"""glTF 2.0 with animation, in one file (.glb).

The frames of one revision are morph targets of one mesh: position = base + sum_k weight_k * target_k (glTF 2.0,
section 3.7.2.2). Between two frames the positions are interpolated. A cut makes another mesh. Only one mesh has the
scale 1 at a time; the others have the scale 0.
"""
import numpy as np

from softbody.export.drawn_mesh import parts_of
from softbody.export.errors import ExportError
from softbody.export.glb_file import INDICES, VERTICES, GlbFile

MOST_TARGETS = 60  # per mesh: graphics cards hold all of them at once
# glTF has y up and z towards the viewer. Optical frames have y down and z forward; other frames of ROS have z up.
FROM_OPTICAL, FROM_Z_UP = [1, 0, 0, 0], [-0.5**0.5, 0, 0, 0.5**0.5]
MATERIALS = {"body": [1, 1, 1, 1], "cut": [0.6, 0.08, 0.06, 1]}


class Scene:
    """Takes states in order, and writes body.glb."""

    def __init__(self, folder, texture):
        self.file, self.texture = GlbFile(folder / "body.glb"), texture
        self.nodes, self.meshes, self.samplers, self.channels = [], [], [], []
        self.segment = self.last = self.frame = self.has_image = self.start = None

    def add(self, time, state):
        if self.frame is None:
            self.frame, self.has_image = state.frame, bool(self.texture) and state.texture_coordinates is not None
            self.start = time
        if state.frame != self.frame:
            raise ExportError(f"the states are in frame {self.frame}, and in {state.frame} after {time:.3f} s; "
                              "export each part with --from and --to")
        time -= self.start  # the animation begins at 0
        if self.segment is None or not _is_same(state.topology, self.segment.topology):
            self._begin(time, state)
        elif len(self.segment.targets) == MOST_TARGETS:
            self._begin(*self.last)  # shares a frame, so that the motion goes on smoothly
            self.segment.add(time, state)
        else:
            self.segment.add(time, state)
        self.last = time, state

    def finish(self):
        self._end_segment(None)
        document = self.file.document
        last_material = max(primitive["material"] for mesh in self.meshes for primitive in mesh["primitives"])
        materials, images = self._materials()
        root = {"name": "body", "children": list(range(len(self.nodes))), "extras": {"frame_id": self.frame},
                "rotation": FROM_OPTICAL if "optical" in self.frame else FROM_Z_UP}
        document.update(scene=0, scenes=[{"nodes": [len(self.nodes)]}], nodes=[*self.nodes, root], meshes=self.meshes,
                        materials=materials[:last_material + 1], **images)
        if self.channels:
            document["animations"] = [{"name": "motion", "samplers": self.samplers, "channels": self.channels}]
        self.file.close()

    def _begin(self, time, state):
        self._end_segment(time)
        parts = self.segment.parts if self.segment and _is_same(state.topology, self.segment.topology) else None
        self.segment = Segment(self.file, parts or PlacedParts(self.file, state.topology, self.has_image), time, state)

    def _end_segment(self, end):
        """Makes a node of the segment. @param end: time at which the next one begins, or None."""
        if self.segment is None:
            return
        segment, node = self.segment, len(self.nodes)
        self.meshes.append(segment.mesh())
        is_first = node == 0
        self.nodes.append({"name": f"revision {segment.topology.revision} from {segment.times[0]:.3f} s", "mesh": node,
                           "scale": [float(is_first)] * 3, "extras": {"revision": segment.topology.revision}})
        if segment.targets:
            weights = np.eye(len(segment.times), dtype=np.float32)[:, 1:]
            self._animate(node, "weights", "LINEAR", segment.times, weights.ravel())
        keys = ([] if is_first else [(0.0, 0.0), (segment.times[0], 1.0)]) + ([] if end is None else [(end, 0.0)])
        if keys:
            keys = [(0.0, 1.0), *keys] if is_first else keys
            times, scales = zip(*keys)
            self._animate(node, "scale", "STEP", times, np.repeat(np.float32(scales)[:, None], 3, axis=1))

    def _animate(self, node, path, interpolation, times, values):
        self.samplers.append({"input": self.file.add_accessor(np.float32(times)), "interpolation": interpolation,
                              "output": self.file.add_accessor(values)})
        self.channels.append({"sampler": len(self.samplers) - 1, "target": {"node": node, "path": path}})

    def _materials(self):
        """The materials in the order of MATERIALS, and what they refer to."""
        surface = {"metallicFactor": 0, "roughnessFactor": 0.9}
        materials = [{"name": name, "doubleSided": True, "pbrMetallicRoughness": {**surface, "baseColorFactor": color}}
                     for name, color in MATERIALS.items()]
        if not self.has_image:
            return materials, {}
        materials[0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        view = self.file.add_bytes(self.texture.content)
        return materials, {"images": [{"bufferView": view, "mimeType": self.texture.mime_type}],
                           "samplers": [{}], "textures": [{"source": 0, "sampler": 0}]}


def _is_same(a, b):
    """Whether two topologies can share a mesh. A topology is sent again every second."""
    return a is b or (a.revision == b.revision and np.array_equal(a.triangles, b.triangles)
                      and len(a.rest_vertices) == len(b.rest_vertices))


class PlacedParts:
    """The parts of a topology, with accessors of what does not move."""

    def __init__(self, file, topology, has_image):
        self.parts, self.primitives = parts_of(topology, has_image), []
        for part in self.parts:
            attributes = {}
            if part.texture is not None:
                attributes["TEXCOORD_0"] = file.add_accessor(part.texture, VERTICES)
            if part.colors is not None:
                attributes["COLOR_0"] = file.add_accessor(part.colors, VERTICES, normalized=True)
            self.primitives.append({"attributes": attributes, "mode": 4, "material": list(MATERIALS).index(part.material),
                                    "indices": file.add_accessor(part.triangles.ravel(), INDICES)})


class Segment:
    """Frames of one revision: the first is the base, the others are morph targets."""

    def __init__(self, file, parts, time, state):
        self.file, self.parts, self.topology = file, parts, state.topology
        self.times, self.targets, self.base = [time], [], state.vertices
        self.bases = self._accessors(state.vertices)

    def add(self, time, state):
        self.times.append(time)
        difference = state.vertices.astype(float) - self.base
        self.targets.append(self._accessors(difference.astype(np.float32)))

    def mesh(self):
        primitives = []
        for index, primitive in enumerate(self.parts.primitives):
            attributes = {"POSITION": self.bases[index], **primitive["attributes"]}
            targets = [{"POSITION": accessors[index]} for accessors in self.targets]
            primitives.append({**primitive, "attributes": attributes, **({"targets": targets} if targets else {})})
        weights = {"weights": [0.0] * len(self.targets)} if self.targets else {}
        return {"primitives": primitives, **weights}

    def _accessors(self, vertices):
        return [self.file.add_accessor(vertices[part.vertices], VERTICES) for part in self.parts.parts]
