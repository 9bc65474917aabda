"""Views that turn: lobes, tables and strand states in a notebook or a window, by PyVista.

Each function gives a `pyvista.Plotter`; `.show()` opens it, in a notebook in the browser where trame is installed. PyVista is not
needed for the rest of the package: `pip install "pyvista[jupyter]"`. The same views without Python: `cuticle view`.
"""
import math
import pathlib
import xml.etree.ElementTree

import numpy

from . import _cuticle
from ._errors import Error
from ._inputs import floats, indices, path as path_of, settings
from ._progress import ticking

__all__ = ["lobe_surface", "lobes", "lut", "page", "paths", "plan", "shadow", "strands"]

# The same as LOBE_COLORS of cuticle_report.
_COLORS = {"R": (0.20, 0.47, 0.75), "TT": (0.93, 0.60, 0.13), "TRT": (0.75, 0.22, 0.27), "residual": (0.35, 0.62, 0.36)}
_DIVERGING = {"stretch": 1.0, "twist": 0.0}
_TITLES = {"contact": "distance to the nearest collider [m]", "guard_fired": "guard fired", "stretch": "stretch [length / rest length]", "tension": "tension over mass per length [m^2/s^2]",
           "curvature": "curvature [1/m]", "speed": "speed [m/s]"}


def _pyvista():
    try:
        import pyvista
    except ImportError as error:
        raise Error(f"views in Python need PyVista: {error}", "no_device",
                    'pip install "pyvista[jupyter]", or the program: cuticle view') from None
    return pyvista


def _values(model, set, theta_i_deg, preset, hair, h, rows, columns):
    """S of every lobe, {name: (rows, columns)}: means over some degrees of phi, as a caustic is infinite."""
    text = settings(set)
    if hair:
        text = ",".join(part for part in (_cuticle.hair_mapping(model, hair)[0], text) if part)
    if not abs(theta_i_deg) <= 90 or min(rows, columns) < 3 or max(rows, columns) > 4096:
        raise Error(f"theta_i_deg {theta_i_deg}, rows {rows}, columns {columns}: outside -90 .. 90, 3 .. 4096, 3 .. 4096")
    return _cuticle.lobe_values(model, preset or "", text, math.radians(theta_i_deg), 0.0 if h is None else float(h), int(rows), int(columns))


def _lobes_of(model, lobe, values):
    """One of them, their sum, or all."""
    if lobe == "all":
        return values
    if lobe == "sum":
        return {"sum": sum(values.values())}
    if lobe not in values:
        raise Error(f"lobe: '{lobe}' is not one of sum, all, {', '.join(values)} of {model}")
    return {lobe: values[lobe]}


def _directions(rows, columns):
    """theta_o and phi in degrees, (rows, columns) each."""
    theta = numpy.linspace(-90, 90, rows)[:, None] * numpy.ones(columns)
    return theta, numpy.linspace(-180, 180, columns)[None, :] * numpy.ones((rows, 1))


def _surface(values, theta, phi, peak, log, decades=3.0):
    with numpy.errstate(divide="ignore"):
        radius = 1 + numpy.log10(values / peak) / decades if log else values / peak
    radius = numpy.clip(radius, 0, 1)
    theta, phi = numpy.radians(theta), numpy.radians(phi)
    direction = numpy.stack([numpy.cos(theta) * numpy.cos(phi), numpy.cos(theta) * numpy.sin(phi), numpy.sin(theta)], axis=-1)
    return radius[..., None] * direction


def _peak(values) -> float:
    return float(numpy.quantile(values, 0.999)) or 1.0


def lobe_surface(model: str, lobe="sum", set=None, *, theta_i_deg=30.0, preset=None, hair=None, h=None, decades=3.0, log=True,
                 rows=91, columns=241):
    """S of a lobe as a polar surface, for light from theta_i_deg: positions (rows, columns, 3), S (rows, columns) in 1/sr, the mean of
    r, g and b and over some degrees of phi (a caustic is infinite), and the S at radius 1, the 99.9th
    percentile. z is the fibre, x the light's side; the radius is log10 S over `decades` below that, or S over it. No PyVista needed."""
    theta, phi = _directions(rows, columns)
    (values,) = _lobes_of(model, lobe, _values(model, set, theta_i_deg, preset, hair, h, rows, columns)).values()
    return _surface(values, theta, phi, _peak(values), log, decades), values, _peak(values)


def _grid(pyvista, points, arrays):
    rows, columns = points.shape[:2]
    grid = pyvista.StructuredGrid()
    grid.points = points.reshape(-1, 3)
    grid.dimensions = (columns, rows, 1)
    for name, values in arrays.items():
        grid[name] = values.ravel()
    return grid


def page(groom, folder="viewer", set=None, *, preset=None, hair=None, head=None, title="hair", strands=20000, three=None, progress=None):
    """Writes index.html and hair.js into a folder: a page for any browser with WebGL 2, opened from disk, with sliders for the parameters of the model
    marschner (a round fibre). Without set, preset and hair it is blond.

    head: the mesh that the hair grows on (positions, triangles). strands: at most so many are shown, as much wider as they are fewer.
    three: the folder of npm's package three; none: CUTICLE_THREE, or node_modules here or above. Gives the path of index.html.
    """
    text = settings(set)
    if hair or not (text or preset):
        mapped = _cuticle.hair_mapping("marschner", hair or "blond")[0] + ",aspect=1"
        text = ",".join(part for part in (mapped, text) if part)
    if not 1 <= int(strands) <= 200000:
        raise Error(f"strands {strands} is outside 1 .. 200000")
    mesh = (floats("positions", head[0], 3), indices("triangles", head[1], 3)) if head is not None else (None, None)
    with ticking(progress, "page"):
        _cuticle.write_page(groom, preset or "", text, *mesh, title, int(strands), path_of(three) if three else "", path_of(folder))
    return pathlib.Path(folder) / "index.html"


def lobes(model="marschner", set=None, *, theta_i_deg=30.0, preset=None, hair=None, h=None, log=True, lobe="all", plotter=None):
    """S of a model over the outgoing directions as surfaces, one a lobe, or `lobe` alone; `model`: a name, or several side by side."""
    pyvista = _pyvista()
    names = [model] if isinstance(model, str) else list(model)
    plotter = plotter or pyvista.Plotter(shape=(1, len(names)), window_size=(700 * len(names), 700))
    theta, phi = _directions(91, 241)
    values = {name: _lobes_of(name, lobe, _values(name, set, theta_i_deg, preset, hair, h, *theta.shape)) for name in names}
    peak = max(_peak(sum(of_model.values())) for of_model in values.values())
    for place, name in enumerate(names):
        plotter.subplot(0, place)
        for shown, s in values[name].items():
            plotter.add_mesh(_grid(pyvista, _surface(s, theta, phi, peak, log), {"S [1/sr]": s}), label=shown,
                             color=_COLORS.get(shown, (0.5, 0.5, 0.5)), smooth_shading=True)
        angle = numpy.radians(theta_i_deg)
        plotter.add_mesh(pyvista.Line((0, 0, -1.2), (0, 0, 1.2)), color=(0.45, 0.36, 0.28), line_width=6)
        plotter.add_mesh(pyvista.Line((0, 0, 0), (1.25 * numpy.cos(angle), 0, 1.25 * numpy.sin(angle))), color=(0.85, 0.65, 0.05),
                         line_width=4)
        plotter.add_text(f"{name}: S, light from theta_i = {theta_i_deg:g} deg", font_size=10)
        plotter.add_legend(bcolor=None, face="rectangle", size=(0.16, 0.16))
        plotter.camera_position = [(2.4, -4.6, 2.0), (0, 0, 0), (0, 0, 1)]
    if len(names) > 1:
        plotter.link_views()
    return plotter


def paths(theta_i_deg=0.0, *, eta=1.55, aspect=1.0, turned_deg=0.0, rays=25, plotter=None):
    """Rays of R, TT and TRT through the cross-section of a fibre, round or elliptical (`aspect`: the axis across the light over that along it,
    turned by turned_deg), with the ray of the caustic; the light comes from +x."""
    pyvista = _pyvista()
    if not (1 < eta and 0.1 <= aspect <= 10 and abs(theta_i_deg) < 90 and 1 <= rays <= 10000):
        raise Error(f"eta {eta}, aspect {aspect}, theta_i_deg {theta_i_deg}, rays {rays}: outside (1, inf), .1 .. 10, -90 .. 90, 1 .. 10000")
    offsets = 0.999 * numpy.linspace(-1, 1, rays) if rays > 1 else numpy.zeros(1)
    section = (float(eta), *numpy.radians([theta_i_deg]).tolist(), float(aspect), float(numpy.radians(turned_deg)))
    meets, leaves, phi, _, caustic = _cuticle.section_paths(*section, offsets)
    plotter = plotter or pyvista.Plotter()
    for k, lobe in enumerate(("R", "TT", "TRT")):
        inside = numpy.concatenate([meets[:, :1] + [2.0, 0.0], meets[:, :k + 1], meets[:, k][:, None] + 1.2 * leaves[:, k][:, None]], axis=1)
        lines = pyvista.MultiBlock([pyvista.lines_from_points(numpy.pad(ray, ((0, 0), (0, 1)))) for ray in inside])
        plotter.add_mesh(lines, color=_COLORS[lobe], line_width=2, label=lobe)
    around = numpy.radians(numpy.linspace(0, 360, 361))
    along, across = (1 / aspect, 1.0) if aspect >= 1 else (1.0, aspect)
    ring = numpy.stack([along * numpy.cos(around), across * numpy.sin(around)], axis=-1)
    turn = numpy.radians(turned_deg)
    ring = ring @ numpy.array([[numpy.cos(turn), numpy.sin(turn)], [-numpy.sin(turn), numpy.cos(turn)]])
    plotter.add_mesh(pyvista.lines_from_points(numpy.pad(ring, ((0, 0), (0, 1)))), color=(0.3, 0.3, 0.3), line_width=3)
    if caustic > 0:
        at = _cuticle.section_paths(*section, numpy.array([caustic]))
        leaving = at[0][0, 2] + numpy.array([[0.0], [2.0]]) * at[1][0, 2]
        plotter.add_mesh(pyvista.lines_from_points(numpy.pad(leaving, ((0, 0), (0, 1)))), color=(0, 0, 0), line_width=4,
                         label=f"caustic: h = {caustic:.3f}, phi = {abs(numpy.degrees(at[2][0, 2])):.1f} deg")
    plotter.add_legend(bcolor=None)
    plotter.view_xy()
    return plotter


def plan(picture, quantity="cost", *, tile=16, plotter=None):
    """What each pixel ("cost", "samples"), tile ("tile_cost") or strand ("strand_cost") of a picture cost, in segments, from the layers of
    FRAME.exr of `cuticle render --aovs`; the title says which shares of the pixels were shaded, culled and skipped."""
    pyvista = _pyvista()
    names = ("cost", "samples", "tile_cost", "strand_cost")
    if quantity not in names:
        raise Error(f"quantity: '{quantity}' is not one of {', '.join(names)}")
    *maps, shares = _cuticle.cost_maps(path_of(picture), int(tile))
    values = dict(zip(names, maps))[quantity]
    side = float(tile) if quantity == "tile_cost" else 1.0
    grid = pyvista.ImageData(dimensions=(values.shape[1] + 1, values.shape[0] + 1, 1), spacing=(side, side, 1.0))
    grid.cell_data[quantity] = values.ravel()
    plotter = plotter or pyvista.Plotter()
    plotter.add_mesh(grid, scalars=quantity, cmap="viridis", lighting=False, scalar_bar_args={"title": f"{quantity} [segments]"})
    plotter.add_text("pixels: {:.0f} % shaded, {:.0f} % culled, {:.0f} % skipped".format(*(100 * share for share in shares)), font_size=10)
    plotter.view_xy()
    return plotter


def _frames(run) -> list:
    """Files of a run: of a folder's states.pvd, of a .pvd, or the file itself."""
    path = pathlib.Path(run)
    if path.is_dir():
        path = path / "states.pvd"
    if path.suffix != ".pvd":
        return [path]
    try:
        sets = xml.etree.ElementTree.parse(path).getroot().iter("DataSet")
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        raise Error(f"{path}: {error}", "bad_input") from None
    return [path.parent / one.get("file") for one in sets]


def _collider_mesh(pyvista, values, *rest):
    """Of positions and triangles, or of a distance field's values, origin, spacing and place: its level 0."""
    if len(rest) == 1:
        (triangles,) = rest
        return pyvista.PolyData(values, numpy.column_stack([numpy.full(len(triangles), 3), triangles]).ravel())
    origin, spacing, place = rest
    grid = pyvista.ImageData(dimensions=values.shape[::-1], spacing=(spacing,) * 3, origin=origin)
    grid["distance"] = values.ravel()
    return grid.contour([0.0], scalars="distance").transform(place, inplace=False)


def _surroundings(pyvista, plotter, file, density, groom):
    """Colliders of the run where they stand in this state, and hair's density."""
    for collider in _cuticle.run_colliders(str(file)):
        plotter.add_mesh(_collider_mesh(pyvista, *collider), color=(0.8, 0.78, 0.75), smooth_shading=True, split_sharp_edges=True)
    if density:
        values, origin = _cuticle.hair_density(groom, float(density))
        grid = pyvista.ImageData(dimensions=values.shape[::-1], spacing=(density,) * 3, origin=origin)
        grid["density"] = values.ravel()
        plotter.add_volume(grid, scalars="density", cmap="viridis", opacity="linear", scalar_bar_args={"title": "length of hair per volume [mm/mm^3]"})


def strands(run, color="stretch", frame=-1, *, plotter=None, line_width=2, density=None):
    """A state of a run of `cuticle simulate` (a folder, a .pvd or a .vtp), coloured by an array of it; "speed" is the length of
    the velocity, "guard_fired" 1 where a strand was reset, "contact" metres to the nearest collider. The run's colliders are drawn
    with it (a distance field as its level 0), and with density (metres, a cell) hair's length per volume."""
    pyvista = _pyvista()
    files = _frames(run)
    if not -len(files) <= frame < len(files):
        raise Error(f"frame: {frame} is outside {-len(files)} .. {len(files) - 1}")
    lines = pyvista.read(str(files[frame]))
    if "velocity" in lines.point_data:
        lines["speed"] = numpy.linalg.norm(lines["velocity"], axis=1)
    known = sorted({*lines.point_data.keys(), *lines.cell_data.keys()})
    if color not in known:
        raise Error(f"color: '{color}' is not in {files[frame].name}, which has {', '.join(known)}")
    plotter = plotter or pyvista.Plotter()
    middle = _DIVERGING.get(color)
    reach = None if middle is None else max(float(numpy.abs(lines[color] - middle).max()), 1e-6)
    plotter.add_mesh(lines, scalars=color, line_width=line_width, cmap="viridis" if middle is None else "coolwarm",
                     clim=None if middle is None else (middle - reach, middle + reach), lighting=False,
                     scalar_bar_args={"title": _TITLES.get(color, color) + "\n"})
    if files[frame].suffix == ".vtp":
        _surroundings(pyvista, plotter, files[frame], density, _cuticle.load_groom(str(files[frame]), 1.0, 0.0, False))
    plotter.add_text(files[frame].name, font_size=10)
    plotter.camera_position = "xy"
    return plotter


def lut(values, *, title="", height=0.5, plotter=None):
    """A table (rows, columns), such as a channel of `bake`, as a height field over its texture coordinates."""
    pyvista = _pyvista()
    values = numpy.asarray(values, dtype=float)
    if values.ndim != 2 or min(values.shape) < 2:
        raise Error(f"values: a table of two dimensions is needed, this has the shape {values.shape}")
    rows, columns = values.shape
    u, v = numpy.meshgrid((numpy.arange(columns) + 0.5) / columns, (numpy.arange(rows) + 0.5) / rows)
    points = numpy.stack([u, v, height * values / max(float(numpy.abs(values).max()), 1e-30)], axis=-1)
    plotter = plotter or pyvista.Plotter()
    plotter.add_mesh(_grid(pyvista, points, {title or "value": values}), scalars=title or "value",
                     cmap="viridis")
    plotter.show_bounds(xtitle="u", ytitle="v", ztitle=f"{height:g} value / peak", location="outer")
    plotter.camera_position = [(1.9, -2.2, 1.6), (0.5, 0.5, 0.15), (0, 0, 1)]
    return plotter


def shadow(groom, light=(0.5, 1, 0.6), *, method="deep_opacity", cells=40, alpha=0.4, plotter=None):
    """Transmittance of a light through a groom as a volume over its bounds."""
    from . import shadows
    pyvista = _pyvista()
    lower, upper = groom.positions.min(axis=0), groom.positions.max(axis=0)
    step = float((upper - lower).max()) / cells
    size = numpy.maximum(2, numpy.ceil((upper - lower) / step).astype(int) + 1)
    grid = pyvista.ImageData(dimensions=tuple(int(n) for n in size), spacing=(step,) * 3, origin=tuple(float(x) for x in lower))
    points = numpy.ascontiguousarray(grid.points, dtype=numpy.float32)
    grid["transmittance"] = numpy.asarray(shadows.transmittance(groom, light, points, method, alpha=alpha))
    plotter = plotter or pyvista.Plotter()
    plotter.add_volume(grid, scalars="transmittance", cmap="viridis", opacity=[0.6, 0.3, 0.1, 0.0],
                       scalar_bar_args={"title": f"transmittance ({method})"})
    plotter.camera_position = "xy"
    return plotter
