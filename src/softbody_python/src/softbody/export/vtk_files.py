"""VTK's XML files for ParaView: surface (.vtp), tets (.vtu), and an index in time of each (.pvd)."""
import base64

import numpy as np

TET_TYPE = 10  # VTK_TETRA
TYPES = {"f4": "Float32", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}


class VtkSeries:
    """Fields: rest_position [m], standard_deviation [m] and confidence where estimated, piece; of triangles also cut."""

    def __init__(self, folder, _):
        self.folder, self.count = folder, 0
        self.frames = {"surface": [], "volume": []}

    def add(self, time, state):
        self._write("surface", "vtp", time, _poly_data(state))
        if state.volume is not None:
            self._write("volume", "vtu", time, _unstructured_grid(state.volume))
        self.count += 1

    def finish(self):
        for series, frames in self.frames.items():
            if frames:
                rows = [f'<DataSet timestep="{time:.9f}" part="0" file="{name}"/>' for time, name in frames]
                (self.folder / f"{series}.pvd").write_text(_document("Collection", rows), encoding="utf-8")

    def _write(self, series, extension, time, text):
        name = f"{series}_{self.count:06}.{extension}"
        (self.folder / name).write_text(text, encoding="utf-8")
        self.frames[series].append((time, name))


def _document(kind, rows):
    return "\n".join([f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">', f"<{kind}>",
                      *rows, f"</{kind}>", "</VTKFile>", ""])


def _array(name, values):
    """A DataArray. Its content is base64: the number of bytes as UInt64, then the bytes."""
    kind = values.dtype.str[1:]
    columns = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    content = np.uint64(values.nbytes).tobytes() + np.ascontiguousarray(values).tobytes()
    text = base64.b64encode(content).decode()
    return f'<DataArray type="{TYPES[kind]}" Name="{name}"{columns} format="binary">{text}</DataArray>'


def _section(name, arrays):
    return [f"<{name}>", *(_array(key, values) for key, values in arrays.items()), f"</{name}>"]


def _point_fields(positions, topology):
    fields = {"rest_position": topology.rest_vertices, "standard_deviation": positions.standard_deviation,
              "confidence": positions.confidence, "piece": topology.vertex_pieces}
    return {name: values for name, values in fields.items() if values is not None}


def _cells(name, cells, **more):
    offsets = np.arange(1, len(cells) + 1, dtype=np.int64) * cells.shape[1]
    return _section(name, {"connectivity": cells.astype(np.int64).ravel(), "offsets": offsets, **more})


def _poly_data(state):
    cell_fields = {"piece": state.triangle_pieces.astype(np.int32), "cut": state.cut_triangles.astype(np.uint8)}
    return _document("PolyData", [
        f'<Piece NumberOfPoints="{len(state.vertices)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
        f'NumberOfPolys="{len(state.triangles)}">',
        *_section("PointData", _point_fields(state, state.topology)), *_section("CellData", cell_fields),
        *_section("Points", {"Points": state.vertices}), *_cells("Polys", state.triangles), "</Piece>"])


def _unstructured_grid(volume):
    types = np.full(len(volume.tets), TET_TYPE, np.uint8)
    return _document("UnstructuredGrid", [
        f'<Piece NumberOfPoints="{len(volume.vertices)}" NumberOfCells="{len(volume.tets)}">',
        *_section("PointData", _point_fields(volume, volume.topology)),
        *_section("CellData", {"piece": volume.tet_pieces.astype(np.int32)}),
        *_section("Points", {"Points": volume.vertices}), *_cells("Cells", volume.tets, types=types), "</Piece>"])
