"""Results on disk: small Parquet files, each written whole or not at all, that any number of processes may add to."""
import contextlib
import hashlib
import io
import json
import os
import pathlib
import tempfile

import numpy

from .._errors import Error

# Larger arrays lie in files of their own, named by what they hold.
INLINE_BYTES = 1 << 16
_BOOKKEEPING = ("index", "plan", "key", "parameters")


def arrow_package():
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise Error("sweeps keep their results as Parquet, by the package pyarrow, which is not here", "usage", "pip install 'cuticle[sweep]'") from None
    return pyarrow


def _is(column, text):
    """bool (rows)."""
    import pyarrow.compute
    return pyarrow.compute.equal(column, text).to_numpy().astype(bool)


def write_whole(path, content: bytes):
    """The file is there with all of its bytes, or not there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(prefix=".", suffix=".tmp", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(temporary)
        raise


class Store:
    """A folder of results. `table()` gives those of a plan."""

    def __init__(self, folder):
        arrow_package()
        self.folder = pathlib.Path(folder).absolute()

    # Writing, by workers.

    def keep(self, name: str, array):
        """The columns of an array: flat numbers with their shape, or the file that holds it."""
        array = numpy.ascontiguousarray(array)
        if array.ndim == 0:
            return {name: array.item()}
        if array.nbytes <= INLINE_BYTES:
            return {name: array.ravel()} if array.ndim == 1 else {name: array.ravel(), f"{name}.shape": list(array.shape)}
        content = io.BytesIO()
        numpy.save(content, array, allow_pickle=False)
        digest = hashlib.sha256(content.getvalue()).hexdigest()
        place = pathlib.Path("arrays", digest[:2], f"{digest[:32]}.npy")
        if not (self.folder / place).exists():
            write_whole(self.folder / place, content.getvalue())
        return {f"{name}.file": place.as_posix()}

    def columns_of(self, result: dict) -> dict:
        """A task's result as columns: numbers, texts, truth values, and arrays."""
        columns = {}
        for name, value in result.items():
            if isinstance(value, (numpy.ndarray, list, tuple)):
                columns.update(self.keep(str(name), value))
            elif isinstance(value, numpy.generic):
                columns[str(name)] = value.item()
            elif value is None or isinstance(value, (bool, int, float, str)):
                columns[str(name)] = value
            else:
                raise Error(f"result '{name}': {type(value).__name__} is no number, text or array", "usage")
        return columns

    def write(self, name: str, rows: list):
        """Rows as a part of the store. name: unlike those of other parts, such as a block's."""
        arrow = arrow_package()
        names = dict.fromkeys(name for row in rows for name in row)
        columns = {}
        for column in names:
            try:
                columns[column] = arrow.array([row.get(column) for row in rows])
            except (arrow.ArrowInvalid, arrow.ArrowTypeError) as error:
                raise Error(f"result '{column}': of another kind in one item than in the others ({error})", "usage") from None
        content = arrow.BufferOutputStream()
        arrow.parquet.write_table(arrow.table(columns), content, compression="zstd")
        fan = hashlib.sha256(name.encode()).hexdigest()[:2]
        write_whole(self.folder / "parts" / fan / f"{name}.parquet", content.getvalue().to_pybytes())

    def describe(self, plan):
        """Keeps what the plan was, beside the results."""
        path = self.folder / "plans" / f"{plan.digest}.json"
        if not path.exists():
            write_whole(path, (json.dumps(plan.describe(), indent=1) + "\n").encode())

    def fail(self, plan, failure):
        write_whole(self._failure(plan, failure.index), (json.dumps(failure._asdict(), indent=1) + "\n").encode())

    def forgive(self, plan, index):
        self._failure(plan, index).unlink(missing_ok=True)

    def _failure(self, plan, index):
        return self.folder / "failures" / f"{plan.digest}-{index:010d}.json"

    # Reading.

    def parts(self, pattern="*/*.parquet") -> list:
        return sorted((self.folder / "parts").glob(pattern))

    def damaged(self) -> list:
        """Parts that cannot be read: their items are computed again."""
        return [path for path in self.parts() if self._read(path, ["index"]) is None]

    def _read(self, path, columns=None):
        arrow = arrow_package()
        try:
            file = arrow.parquet.ParquetFile(path)
            return file.read() if columns is None else file.read(columns)
        except (arrow.ArrowInvalid, OSError):
            return None

    def done(self, plan) -> numpy.ndarray:
        """bool (items): which items of the plan have results, of this plan or, by their keys, of others."""
        found, foreign = numpy.zeros(len(plan), bool), set()
        for path in self.parts():
            table = self._read(path, ["index", "plan", "key"])
            if table is None:
                continue
            own = _is(table["plan"], plan.digest)
            found[table["index"].to_numpy()[own]] = True
            if not own.all():
                foreign.update(table["key"].filter(~own).to_pylist())
        if foreign:
            for index in numpy.flatnonzero(~found):
                found[index] = plan.key(int(index)) in foreign
        return found

    def indices_of(self, block) -> set:
        """Items that have results in the parts of a block."""
        tables = [self._read(path, ["index"]) for path in self.parts(f"*/{block}-*.parquet")]
        return {index for table in tables if table is not None for index in table["index"].to_pylist()}

    def failures(self, plan) -> list:
        """What is known of items that failed, dictionaries."""
        return [json.loads(path.read_text()) for path in sorted((self.folder / "failures").glob(f"{plan.digest}-*.json"))]

    def table(self, plan, runs=False):
        """The results of a plan as a pyarrow.Table: index, key, what varied, and the results, one row an item, in the plan's order.
        runs: with what belongs to the run (seconds, worker, times), which differs from run to run."""
        arrow = arrow_package()
        tables = [table for path in self.parts() if (table := self._read(path)) is not None]
        if not tables:
            return arrow.table({"index": arrow.array([], arrow.int64())})
        whole = arrow.concat_tables(tables, promote_options="permissive")
        indices, places = self._places(plan, whole)
        rows = whole.take(arrow.array(places))
        columns = {"index": arrow.array(indices), "key": rows["key"]}
        for name, values in plan.columns(indices).items():
            columns[name] = _values_column(arrow, values)
        for name in sorted(set(rows.column_names) - set(_BOOKKEEPING)):
            if runs or not name.startswith("run_"):
                columns[name if name not in columns else f"result.{name}"] = rows[name]
        return _without_empty(arrow.table(columns))

    @staticmethod
    def _places(plan, whole):
        """(indices of items, their rows), in the plan's order: the first row of each, by its own plan's index, or else by the key."""
        own = numpy.flatnonzero(_is(whole["plan"], plan.digest))
        indices, first = numpy.unique(whole["index"].to_numpy()[own], return_index=True)
        places = own[first]
        if len(indices) < len(plan) and len(own) < len(whole):
            by_key = {key: row for row, key in reversed(list(enumerate(whole["key"].to_pylist())))}
            missing = numpy.setdiff1d(numpy.arange(len(plan)), indices)
            more = numpy.array([(index, by_key[key]) for index in missing if (key := plan.key(int(index))) in by_key], numpy.int64).reshape(-1, 2)
            indices, places = numpy.concatenate([indices, more[:, 0]]), numpy.concatenate([places, more[:, 1]])
            order = numpy.argsort(indices)
            indices, places = indices[order], places[order]
        return indices, places

    def array(self, row: dict, name: str) -> numpy.ndarray:
        """The array that a row of the table (`table.to_pylist()[i]`) names."""
        if f"{name}.file" in row and row[f"{name}.file"] is not None:
            return numpy.load(self.folder / row[f"{name}.file"], allow_pickle=False)
        values, shape = numpy.array(row[name]), row.get(f"{name}.shape")
        return values if shape is None else values.reshape(shape)

    def compact(self):
        """All parts as one. Processes may not write meanwhile."""
        arrow = arrow_package()
        parts = [(path, table) for path in self.parts() if (table := self._read(path)) is not None]
        if len(parts) < 2:
            return
        whole = arrow.concat_tables([table for _, table in parts], promote_options="permissive")
        content = arrow.BufferOutputStream()
        arrow.parquet.write_table(whole, content, compression="zstd")
        data = content.getvalue().to_pybytes()
        path = self.folder / "parts" / "00" / f"compact-{hashlib.sha256(data).hexdigest()[:16]}.parquet"
        write_whole(path, data)
        for old, _ in parts:
            if old != path:
                old.unlink(missing_ok=True)


def _values_column(arrow, values):
    """Numbers, texts and lists as they are; what differs in kind, or is a dictionary, as JSON text."""
    plain = [value.tolist() if isinstance(value, (numpy.ndarray, numpy.generic)) else value for value in values]
    if not any(isinstance(value, dict) for value in plain):
        with contextlib.suppress(arrow.ArrowInvalid, arrow.ArrowTypeError):
            return arrow.array(plain)
    return arrow.array([None if value is None else json.dumps(value, default=lambda other: repr(other)[:80]) for value in plain])


def _without_empty(table):
    """Columns of other plans in the same store have nothing in these rows."""
    return table.select([name for name in table.column_names if len(table) == 0 or table[name].null_count < len(table)])
