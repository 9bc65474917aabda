"""JSON in, with messages that name the file."""
import json

from . import ReportError


def read_json(path):
    """The object in a JSON file."""
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ReportError(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise ReportError(f"{path}: not JSON: {error}") from error
    if not isinstance(value, dict):
        raise ReportError(f"{path}: not a JSON object")
    return value
