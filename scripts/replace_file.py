"""Files that appear under their name only when they are complete."""
import os
import tempfile


def replace_file(path, text):
    """Writes a new file in the same folder and renames it. If that fails, an earlier file stays and nothing is left."""
    number, temporary = tempfile.mkstemp(prefix=f"{path.stem}.part-", suffix=path.suffix, dir=path.parent)
    try:
        with open(number, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(temporary, 0o644)
        os.rename(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
