"""Pages and figures from the data that the program writes."""


class ReportError(Exception):
    """The data are missing or not as the README describes; the message names the file and the key."""
