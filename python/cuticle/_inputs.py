"""From what a caller gives to what the compiled half takes."""
import json
import os
import pathlib

import numpy

from ._errors import Error


def text_of(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (tuple, list, numpy.ndarray)):
        return "/".join(text_of(part) for part in value)
    return str(value)


def settings(values):
    """{"eta": 1.55, "sigma_a": (0.1, 0.2, 0.4)} as the program's --set takes it; a text goes through."""
    if values is None or isinstance(values, str):
        return values or ""
    return ",".join(f"{name}={text_of(value)}" for name, value in values.items())


def plain(value):
    """What JSON has no form for, in one that it has."""
    if isinstance(value, (numpy.generic, numpy.ndarray)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{value!r:.60} is no part of a JSON text")


def to_json(value):
    return json.dumps(value, default=plain)


def blocks(value):
    """Effects by name with their parameters; a list of names takes the defaults."""
    if value is None:
        return "{}"
    if not isinstance(value, dict):
        value = {name: {} for name in value}
    return to_json(value)


def as_array(value):
    """Of numpy, or of another library by DLPack (PyTorch, JAX), without a copy where it lies in the CPU's memory."""
    if not isinstance(value, numpy.ndarray) and hasattr(value, "__dlpack__"):
        return numpy.from_dlpack(value)
    return numpy.asarray(value)


def single(value):
    """float32, contiguous; no copy where it is that already."""
    return numpy.ascontiguousarray(as_array(value), numpy.float32)


def numbers(name, value):
    """An array of numbers; what merely converts to one (None, texts, dates, truth values) is refused."""
    array = as_array(value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: {value!r:.60} is no number and no array of numbers")
    return numpy.ascontiguousarray(array, dtype=numpy.float64).reshape(array.shape)


def _array(name, value, kind, columns):
    array = as_array(value)
    if array.size == 0:
        return numpy.zeros((0, columns) if columns else (0,), kind)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: {value!r:.60} is no array of numbers")
    if columns and (array.ndim != 2 or array.shape[1] != columns) or not columns and array.ndim != 1:
        wanted = f"(n, {columns})" if columns else "(n,)"
        raise Error(f"{name}: an array of shape {array.shape}, not {wanted}", "bad_input")
    return numpy.ascontiguousarray(array, dtype=kind)


def floats(name, value, columns=0):
    """float32 of shape (n,) or (n, columns); no copy where it is that already."""
    return _array(name, value, numpy.float32, columns)


def doubles(name, value, columns=0):
    return _array(name, value, numpy.float64, columns)


def indices(name, value, columns=0):
    array = as_array(value)
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise Error(f"{name}: whole numbers from 0 to 4294967295 are needed", "bad_input")
    return _array(name, array, numpy.uint32, columns)


def triple(name, value):
    array = numbers(name, value)
    if array.shape != (3,):
        raise Error(f"{name}: an array of shape {array.shape}, not (3,)", "bad_input")
    return tuple(array.tolist())


def path(value):
    named = os.fspath(value)
    return named if isinstance(named, str) else os.fsdecode(named)


def document(value, folder=None):
    """(JSON text, folder of relative paths) of a dictionary, or of a file by its path."""
    if isinstance(value, dict):
        return to_json({"schema_version": 1, **value}), path(folder or os.getcwd())
    file = pathlib.Path(path(value))
    try:
        return file.read_text(encoding="utf-8"), str(folder or file.resolve().parent)
    except OSError as error:
        raise Error(f"{file}: {error.strerror}", "bad_input") from None
