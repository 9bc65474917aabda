"""Tables of results as files. The same table gives the same bytes."""
import csv
import io
import json
import pathlib

from .._errors import Error
from .store import arrow_package, write_whole


def _csv(table):
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(table.column_names)
    lines.writerows([json.dumps(value) if isinstance(value, list) else value for value in row.values()] for row in table.to_pylist())
    return text.getvalue().encode()


def _json(table):
    return "".join(json.dumps(row) + "\n" for row in table.to_pylist()).encode()


def _parquet(table):
    arrow = arrow_package()
    content = arrow.BufferOutputStream()
    arrow.parquet.write_table(table, content, compression="zstd")
    return content.getvalue().to_pybytes()


_WRITERS = {".parquet": _parquet, ".csv": _csv, ".json": _json}


def write_table(table, path):
    """By the path's ending: .parquet, .csv, or .json with a line a row."""
    path = pathlib.Path(path)
    if path.suffix not in _WRITERS:
        raise Error(f"{path}: '{path.suffix}' is not one of {', '.join(_WRITERS)}", "usage")
    write_whole(path, _WRITERS[path.suffix](table))
