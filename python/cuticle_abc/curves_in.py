"""Alembic curves as the arrays of a groom (.npz), in the file's unit."""
import re

import numpy

from . import archive

SPECIAL = {"root_triangle": numpy.uint32, "root_uv": numpy.float32, "root_barycentrics": numpy.float32}


def kept_points(sample, counts):
    """Indices of the points that are kept, points left per curve, and what to say: joints of Bezier curves, else every point."""
    total = int(counts.sum())
    every = numpy.arange(total)
    if str(sample.getType()) != "kCubic":
        return every, counts, ""
    basis = str(sample.getBasis()).removeprefix("k").removesuffix("Basis")
    if basis == "Bezier" and (counts % 3 == 1).all() and not len(sample.getKnots() or ()):
        local = every - numpy.repeat(numpy.cumsum(counts) - counts, counts)
        return every[local % 3 == 0], (counts + 2) // 3, "the joints of Bezier curves are kept"
    if basis in ("Hermite", "Power"):
        raise ValueError(f"curves of the basis {basis}: linear, Bezier, B-spline, Catmull-Rom are read")
    return every, counts, "" if basis == "Catmullrom" else f"the control points of {basis} curves are taken as their points; the curves run beside them"


def spread(found, counts, name):
    """A property's values and "strand" or "vertex"; one for all becomes one a strand."""
    strands, points, rows = len(counts), int(counts.sum()), len(found.values)
    if rows == 1 and (found.scope in ("con", "") or strands == 1 != points):
        return numpy.repeat(found.values, strands, axis=0), "strand"
    if rows == strands and (rows != points or found.scope in ("uni", "")):
        return found.values, "strand"
    if rows == points:
        return found.values, "vertex"
    raise ValueError(f"{name}: {rows} values for {strands} curves of {points} points")


def widths_of(stored, extra, counts):
    """Diameters of every point, or None."""
    found = stored.get("width", extra.get("groom_width"))
    if found is None:
        return None
    values, domain = spread(found, counts, "widths")
    return values[:, 0] if domain == "vertex" else numpy.repeat(values[:, 0], counts)


def attribute_name(name):
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name.removeprefix("groom_"))
    return plain if plain[:1].isalpha() else "a_" + plain


def attributes_of(curves, extra, counts, picks):
    left_out, found = {"groom_width", "groom_version_major", "groom_version_minor"}, {}
    for name, each in extra.items():
        if name in left_out:
            continue
        values, domain = spread(each, counts, name)
        if name == "groom_id" and (values[:, 0] == numpy.arange(len(values))).all():
            continue
        found[attribute_name(name)] = (values[picks] if domain == "vertex" else values, domain)
    if "root_uv" not in found and (uvs := curves.stored.get("uv")) is not None and len(uvs.values) == len(counts):
        found["root_uv"] = (uvs.values, "strand")
    return found


def one(curves, said):
    """Counts, places, radii or None, attributes of one object."""
    schema = curves.schema
    if schema.getNumSamples() == 0:
        raise ValueError(f"{curves.name}: curves without a sample")
    if schema.getNumSamples() > 1 or curves.moves:
        said.add("it moves: the first sample is read")
    sample = schema.getValue()
    counts, places = curves.counts_and_places()
    if str(sample.getWrap()) == "kPeriodic":
        raise ValueError(f"{curves.name}: closed curves, hair is open")
    extra = archive.properties(schema.getArbGeomParams())
    picks, left, note = kept_points(sample, counts)
    if note:
        said.add(note)
    widths = widths_of(curves.stored, extra, counts)
    scale = abs(numpy.linalg.det(curves.matrix[:3, :3])) ** (1 / 3)
    places = places @ curves.matrix[:3, :3] + curves.matrix[3, :3]
    return left, places[picks], None if widths is None else widths[picks] * (scale / 2), attributes_of(curves, extra, counts, picks)


def together(parts, said):
    """One groom of every object: attributes that all have, in one form."""
    arrays = {"offsets": numpy.concatenate([[0], numpy.cumsum(numpy.concatenate([part[0] for part in parts]))]).astype(numpy.uint32),
              "positions": numpy.concatenate([part[1] for part in parts]).astype(numpy.float32)}
    if all(part[2] is not None for part in parts):
        arrays["radii"] = numpy.concatenate([part[2] for part in parts]).astype(numpy.float32)
    for name in sorted({name for part in parts for name in part[3]}):
        forms = {(part[3][name][1], part[3][name][0].shape[1]) if name in part[3] else None for part in parts}
        if len(forms) > 1:
            said.add(f"{name} is left out: not every curves object has it in one form")
            continue
        values, domain = numpy.concatenate([part[3][name][0] for part in parts]), forms.pop()[0]
        if name in SPECIAL and domain == "strand":
            arrays[name] = values.astype(SPECIAL[name]) if values.shape[1] > 1 else values[:, 0].astype(SPECIAL[name])
        else:
            arrays[f"{domain}_{name}"] = values.astype(numpy.float32) if values.shape[1] > 1 else values[:, 0].astype(numpy.float32)
    return arrays


def read(source, target):
    opened, said = archive.opened(source), set()
    found = archive.curves_of(opened)
    if not found:
        raise ValueError("it holds no curves")
    parts = [part for part in (one(curves, said) for curves in found) if len(part[0])]
    if not parts:
        raise ValueError("its curves objects are empty")
    if len(parts) > 1:
        said.add(f"{len(parts)} curves objects are one groom")
    numpy.savez(target, **together(parts, said))
    return [repr(archive.unit_of(opened)), *sorted(said)]
