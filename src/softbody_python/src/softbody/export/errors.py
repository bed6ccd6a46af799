"""What the command line tells its user."""


class ExportError(Exception):
    """The data cannot be exported. The message is a sentence for the user."""
