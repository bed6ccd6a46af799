"""The image of an object's visual mesh."""
import pathlib

import yaml

from softbody.export.errors import ExportError

KINDS = {b"\x89PNG\r\n\x1a\n": ("png", "image/png"), b"\xff\xd8\xff": ("jpg", "image/jpeg")}


class Texture:
    """An image file, and its kind by content."""

    def __init__(self, path):
        self.path = path
        self.content = path.read_bytes()
        kind = next((kind for start, kind in KINDS.items() if self.content.startswith(start)), None)
        if kind is None:
            raise ExportError(f"{path}: is no PNG or JPEG; convert it, or export without --object")
        self.extension, self.mime_type = kind

    @property
    def name(self):
        return f"texture.{self.extension}"


def texture_of(object_yaml, allow_outside=False):
    """The texture that the OBJ of an object YAML names: the first map_Kd of its material file. None if it names none.

    A folder stands for its object.yaml.

    @throw ExportError if a file is wrong, or outside of the YAML's folder without `allow_outside`. @throw OSError.
    """
    object_yaml = pathlib.Path(object_yaml)
    if object_yaml.is_dir():
        object_yaml = object_yaml / "object.yaml"
    folder = object_yaml.resolve().parent
    mesh = _inside(_visual_mesh(object_yaml), object_yaml, folder, allow_outside)
    if mesh.suffix.lower() != ".obj":
        return None
    materials = _named(mesh, "mtllib", folder, allow_outside)
    image = materials and _named(materials, "map_Kd", folder, allow_outside)
    return image and Texture(image)


def _visual_mesh(object_yaml):
    try:
        document = yaml.safe_load(object_yaml.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ExportError(f"{object_yaml}: is not YAML: {error}") from error
    section = document.get("object") if isinstance(document, dict) else None
    name = section.get("visual_mesh") if isinstance(section, dict) else None
    if not isinstance(name, str):
        raise ExportError(f"{object_yaml}: has no key object/visual_mesh; give the object YAML that was tracked")
    return object_yaml.parent / name


def _named(file, keyword, folder, allow_outside):
    """The file that the first line with a keyword names, or None."""
    for line in file.read_text(encoding="utf-8-sig", errors="replace").splitlines():
        first, *value = line.split(None, 1)[:2] or [""]
        if first.lower() == keyword.lower() and value:
            return _inside(_place(file.parent, value[0].strip().strip('"')), file, folder, allow_outside)
    return None


def _place(folder, name):
    """Where a file is that may be named with backslashes or by a path of another computer."""
    slashed = pathlib.PurePosixPath(name.replace("\\", "/"))
    places = [folder / name, folder / slashed, folder / slashed.name]
    return next((place for place in places if place.is_file()), places[0])


def _inside(path, named_in, folder, allow_outside):
    if not allow_outside and folder not in path.resolve().parents:
        raise ExportError(f"{named_in}: names {path}, which is outside of {folder}; allow it with --allow-outside")
    return path
