"""The container of glTF 2.0 (.glb): a JSON document and one buffer, which may be larger than the memory."""
import json
import os
import shutil
import struct

import numpy as np

from softbody.export.errors import ExportError

FLOAT, UNSIGNED_INT, UNSIGNED_BYTE = 5126, 5125, 5121
COMPONENTS = {"f4": FLOAT, "u4": UNSIGNED_INT, "u1": UNSIGNED_BYTE}
SHAPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
VERTICES, INDICES = 34962, 34963  # targets of buffer views
LARGEST_FILE = 2**32 - 1  # bytes: lengths are stored in 32 bits


class GlbFile:
    """Collects accessors. Their data go to a file of their own at once."""

    def __init__(self, path):
        self.path, self.buffer_path = path, path.with_suffix(".buffer")
        self.buffer = open(self.buffer_path, "wb")
        self.document = {"asset": {"version": "2.0", "generator": "softbody export"}, "bufferViews": [], "accessors": []}

    def add_bytes(self, content, target=None):
        """Returns the index of a new buffer view."""
        self.buffer.write(bytes(-self.buffer.tell() % 4))
        view = {"buffer": 0, "byteOffset": self.buffer.tell(), "byteLength": len(content)}
        self.buffer.write(content)
        if self.buffer.tell() > LARGEST_FILE // 2:
            raise ExportError("the file would exceed 2 GB, which few programs read; export fewer frames with --step, "
                              "--from or --to")
        self.document["bufferViews"].append(view if target is None else {**view, "target": target})
        return len(self.document["bufferViews"]) - 1

    def add_accessor(self, values, target=None, normalized=False):
        """Returns the index of a new accessor. @param values: n, or n x 2, 3 or 4, of float32, uint32 or uint8."""
        values = np.ascontiguousarray(values)
        accessor = {"bufferView": self.add_bytes(values.tobytes(), target),
                    "componentType": COMPONENTS[values.dtype.str[1:]], "count": len(values),
                    "type": SHAPES[1 if values.ndim == 1 else values.shape[1]]}
        if values.dtype == np.float32 and len(values):
            rows = values.reshape(len(values), -1)
            accessor.update(min=rows.min(axis=0).tolist(), max=rows.max(axis=0).tolist())
        if normalized:
            accessor["normalized"] = True
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def close(self):
        """Writes the file."""
        self.buffer.write(bytes(-self.buffer.tell() % 4))
        length = self.buffer.tell()
        self.buffer.close()
        self.document["buffers"] = [{"byteLength": length}]
        text = json.dumps(self.document, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        with open(self.path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + length))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", length, b"BIN\0"))
            with open(self.buffer_path, "rb") as buffer:
                shutil.copyfileobj(buffer, file)
        os.unlink(self.buffer_path)
