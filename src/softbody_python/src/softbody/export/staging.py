"""Output that appears under its name only when it is complete."""
import contextlib
import os
import pathlib
import re
import secrets
import shutil
import signal

from softbody.export.errors import ExportError

# The files that an export writes. A folder with another file is somebody's own, and is not replaced.
OWN_FILES = re.compile(r"(surface|volume)(_\d{6,})?\.(ply|obj|vtp|vtu|pvd)|surface\.mtl|texture\.(png|jpg)|frames\.csv|body\.glb")


class Interrupted(BaseException):
    """A signal to end. It is no Exception: nothing but the cleaning up may catch it."""

    def __init__(self, number):
        super().__init__(number)
        self.number = number


def interrupt_on_signals():
    """From now on SIGINT, SIGTERM and SIGHUP raise Interrupted. A signal that is ignored, as with nohup, stays ignored."""
    def interrupt(number, _):
        raise Interrupted(number)

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) not in (signal.SIG_IGN, None):
            signal.signal(number, interrupt)


def end_by_signal(number):
    """Ends the process as the signal would have."""
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)


def check_folder(target):
    """@throw ExportError if something is there that an export must not replace."""
    if target.is_symlink() or (target.exists() and not target.is_dir()):
        raise ExportError(f"{target} is not a folder; choose another one")
    for path in target.iterdir() if target.exists() else ():
        if path.is_symlink() or not path.is_file() or not OWN_FILES.fullmatch(path.name):
            raise ExportError(f"{target} has {path.name}, which is not part of an export; choose another folder")


def check_file(target):
    """@throw ExportError likewise."""
    if target.is_symlink() or (target.exists() and not target.is_file()):
        raise ExportError(f"{target} is not a file that can be replaced; name another one")


@contextlib.contextmanager
def staged_folder(target, single_file=None):
    """A new folder beside the target, which becomes the target at the end.

    @param single_file: only this file of the folder becomes the target. An exception leaves the target as it was.
    """
    target = pathlib.Path(os.path.abspath(target))
    (check_file if single_file else check_folder)(target)
    missing = [parent for parent in target.parents if not parent.exists()]
    folder = _name_beside(target)
    try:
        folder.mkdir(parents=True)
        yield folder
        if single_file:
            os.replace(folder / single_file, target)
        else:
            _swap(folder, target)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        for parent in missing:
            with contextlib.suppress(OSError):  # it has the target
                parent.rmdir()


def _name_beside(target):
    return target.with_name(f"{target.stem}.part-{secrets.token_hex(4)}")


def _swap(folder, target):
    """Gives the folder the target's name. What was there before is removed."""
    check_folder(target)  # again: an export can take long
    if not target.exists():
        os.rename(folder, target)
        return
    earlier = _name_beside(target)
    os.rename(target, earlier)
    try:
        os.rename(folder, target)
    except BaseException:
        os.rename(earlier, target)
        raise
    shutil.rmtree(earlier, ignore_errors=True)
