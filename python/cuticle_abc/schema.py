"""Whether an Alembic file follows Unreal's groom schema; a line a finding: "refuses: WHAT" or "fills in: WHAT"."""
import numpy

from . import archive, names

SCOPES = {"con": "constant", "uni": "uniform", "vtx": "vertex", "": "none"}
CENTIMETRES = (0.5, 200.0)  # of the median strand where the file states no unit: shorter hair looks like metres


def version_of(opened):
    """The two numbers on the topmost transformation or curves, as far as they are there: name -> Property."""
    from alembic3d import AbcGeom
    top, found = opened.getTop(), {}
    for k in range(top.getNumChildren()):
        header = top.getChildHeader(k)
        kind = next((kind for kind in (AbcGeom.IXform, AbcGeom.ICurves) if kind.matches(header)), None)
        if kind:
            schema = kind(top, header.getName()).getSchema()
            for compound in (schema.getUserProperties(), schema.getArbGeomParams()):
                found.update(archive.properties(compound))
    return {name: each for name, each in found.items() if name.startswith("groom_version")}


def version(opened):
    found, said = version_of(opened), []
    for name, wanted in zip(("groom_version_major", "groom_version_minor"), names.VERSION):
        each = found.get(name)
        if each is None:
            said.append(f"refuses: {name} is not on the topmost node")
        elif each.kind != "int16":
            said.append(f"refuses: {name} is of {each.kind}, int16 is needed")
        elif not 0 <= each.values.ravel()[0] <= wanted:
            said.append(f"refuses: {name} {each.values.ravel()[0]}, this schema is {names.VERSION[0]}.{names.VERSION[1]}")
    return said


def attribute(name, each, strands, points):
    known, rows = names.SCHEMA.get(name), len(each.values)
    if name != name.lower():
        return [f"refuses: {name}: names are in lower case"]
    if known is None:
        return []
    said = []
    if each.kind not in known.kinds:
        said.append(f"refuses: {name} is of {each.kind}, allowed {', '.join(known.kinds)}")
    if each.values.shape[1] != known.parts:
        said.append(f"refuses: {name} has {each.values.shape[1]} parts, {known.parts} are needed")
    if each.scope not in known.scopes:
        said.append(f"refuses: {name} has the scope {SCOPES.get(each.scope, each.scope)}, allowed {', '.join(SCOPES[s] for s in known.scopes)}")
    elif rows != (wanted := {"con": 1, "uni": strands, "vtx": points}[each.scope]):
        said.append(f"refuses: {name} has {rows} values, {wanted} are needed")
    if rows and (each.values < known.least).any():
        said.append(f"refuses: {name} goes down to {each.values.min():.4g}, at least {known.least:g} is allowed")
    return said


def curves(each, unit):
    counts, places = each.counts_and_places()
    if not len(counts):
        return []
    extra = archive.properties(each.schema.getArbGeomParams())
    said = [line for name, one in sorted(extra.items()) if name.lower().startswith("groom_")
            for line in attribute(name, one, len(counts), len(places))]
    if "groom_width" not in extra and "width" not in each.stored:
        said.append("fills in: no width: it takes 1 cm")
    if "groom_root_uv" not in extra:
        said.append("fills in: no groom_root_uv: it lays a sphere around the groom")
    if "groom_guide" not in extra:
        said.append("fills in: no groom_guide: it makes guides by decimation")
    return said + size(places @ each.matrix[:3, :3], counts, unit)


def size(places, counts, unit):
    starts = numpy.cumsum(counts) - counts
    steps = numpy.linalg.norm(numpy.diff(places, axis=0, prepend=places[:1]), axis=1)
    steps[starts[counts > 0]] = 0
    lengths = numpy.add.reduceat(steps, starts[counts > 0])
    middle = float(numpy.median(lengths))
    if unit in (0.0, 0.01) and CENTIMETRES[0] <= middle <= CENTIMETRES[1]:
        return []
    return [f"refuses: the median strand is {middle:.4g} units long{f' (units of {unit:g} m)' if unit else ''}, and a unit is 1 cm there: write it with "
            f"--output-metres-per-unit 0.01, or import it with the scale {100 * (unit or 1):g}"]


def check(source):
    opened = archive.opened(source)
    found = archive.curves_of(opened)
    if not found:
        raise ValueError("it holds no curves")
    lines = version(opened)
    for each in found:
        lines += curves(each, archive.unit_of(opened))
    return list(dict.fromkeys(lines))
