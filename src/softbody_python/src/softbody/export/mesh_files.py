"""One PLY or OBJ file of the surface for each frame, and a list of the frames."""
import numpy as np


class MeshSequence:
    """Base of both: numbers the files, copies the texture, and writes frames.csv."""

    def __init__(self, folder, texture):
        self.folder, self.texture = folder, texture
        self.rows = ["file,time_s,stamp_s,revision,frame"]
        if texture:
            (folder / texture.name).write_bytes(texture.content)

    def add(self, time, state):
        name = f"surface_{len(self.rows) - 1:06}.{self.extension}"
        self.write(self.folder / name, state)
        stamp = f"{state.stamp.secs}.{state.stamp.nsecs:09}"
        self.rows.append(f"{name},{time:.9f},{stamp},{state.revision},{state.frame}")

    def finish(self):
        (self.folder / "frames.csv").write_text("\n".join(self.rows) + "\n", encoding="utf-8")


class PlySequence(MeshSequence):
    """Binary PLY. Vertices have standard_deviation [m] (NaN: not estimated) and piece, faces have piece and cut."""

    extension = "ply"

    def write(self, path, state):
        has_texture = state.texture_coordinates is not None
        vertices, faces = _ply_vertices(state), _ply_faces(state)
        header = ["ply", "format binary_little_endian 1.0", f"comment frame_id {state.frame}, metres"]
        header += [f"comment TextureFile {self.texture.name}"] if self.texture and has_texture else []
        header += [f"element vertex {len(vertices)}", "property float x", "property float y", "property float z",
                   "property float standard_deviation", "property int piece", f"element face {len(faces)}",
                   "property list uchar int vertex_indices"]
        header += ["property list uchar float texcoord"] if has_texture else []
        header += ["property int piece", "property uchar cut", "end_header\n"]
        with open(path, "wb") as file:
            file.write("\n".join(header).encode())
            file.write(vertices.tobytes() + faces.tobytes())


def _ply_vertices(state):
    rows = np.empty(len(state.vertices), [("place", "<f4", 3), ("deviation", "<f4"), ("piece", "<i4")])
    rows["place"], rows["piece"] = state.vertices, state.vertex_pieces
    rows["deviation"] = np.nan if state.standard_deviation is None else state.standard_deviation
    return rows


def _ply_faces(state):
    texture = [("six", "u1"), ("texture", "<f4", (3, 2))] if state.texture_coordinates is not None else []
    rows = np.empty(len(state.triangles), [("three", "u1"), ("corners", "<i4", 3), *texture, ("piece", "<i4"), ("cut", "u1")])
    rows["three"], rows["corners"] = 3, state.triangles
    rows["piece"], rows["cut"] = state.triangle_pieces, state.cut_triangles
    if texture:
        rows["six"], rows["texture"] = 6, state.texture_coordinates
    return rows


class ObjSequence(MeshSequence):
    """OBJ with one group per piece. Materials: body, with the texture, and cut."""

    extension = "obj"
    described = None, ""  # a topology, and the text that it gives

    def write(self, path, state):
        if state.topology is not self.described[0]:
            self.described = state.topology, _obj_topology(state)
        vertices = ["v %.9g %.9g %.9g" % tuple(place) for place in state.vertices.tolist()]
        path.write_text("\n".join(["mtllib surface.mtl", *vertices, self.described[1]]), encoding="utf-8")

    def finish(self):
        image = f"map_Kd {self.texture.name}\n" if self.texture else ""
        color = "Kd 1 1 1" if self.texture else "Kd 0.85 0.7 0.45"
        (self.folder / "surface.mtl").write_text(f"newmtl body\n{color}\n{image}newmtl cut\nKd 0.8 0.3 0.25\n", encoding="utf-8")
        super().finish()


def _obj_topology(state):
    """All that the frames of a revision share."""
    lines = []
    if state.texture_coordinates is not None:
        lines += ["vt %.9g %.9g" % tuple(place) for place in state.texture_coordinates.reshape(-1, 2).tolist()]
    for piece in np.unique(state.triangle_pieces):
        for material, is_cut in (("body", False), ("cut", True)):
            chosen = np.flatnonzero((state.triangle_pieces == piece) & (state.cut_triangles == is_cut))
            if len(chosen):
                lines += [f"g piece_{piece}", f"usemtl {material}", *_obj_faces(state, chosen)]
    return "\n".join(lines) + "\n"


def _obj_faces(state, chosen):
    """Faces count from 1. Each corner has its own texture coordinate."""
    corners = (state.triangles[chosen].astype(int) + 1).tolist()
    if state.texture_coordinates is None:
        return ["f %d %d %d" % tuple(face) for face in corners]
    texture = (3 * chosen[:, None] + [1, 2, 3]).tolist()
    return ["f %d/%d %d/%d %d/%d" % (a, s, b, t, c, u) for (a, b, c), (s, t, u) in zip(corners, texture)]
