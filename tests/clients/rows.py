"""A function a row: opens what Cuticle wrote in a program and compares. Each gives a Row, or raises NotRun with why."""
import base64
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import sys

import numpy

import work
import lut_files

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "browser"))


class NotRun(Exception):
    """The program is not here."""


@dataclasses.dataclass
class Row:
    program: str
    version: str
    opened: str
    compared: list = dataclasses.field(default_factory=list)  # (words, holds)
    notes: list = dataclasses.field(default_factory=list)
    pictures: list = dataclasses.field(default_factory=list)

    def check(self, words, holds):
        self.compared.append((words, bool(holds)))


def modules(full):
    """The npm packages of this folder; those of the browser tests hold three.js alone."""
    own = HERE / "node_modules"
    if full and not own.exists():
        subprocess.run(["npm", "ci", "--prefix", HERE, "--silent", "--no-audit", "--no-fund"], check=True)
    return own if own.exists() else HERE.parent / "browser/node_modules"


def page(name, folder, full, needs):
    packages = modules(full)
    if not (packages / needs).exists():
        raise NotRun(f"the npm package {needs} is installed by --full")
    done = work.node(HERE.parent / "browser/run_page.mjs", HERE / "pages", name, f"lut={folder / 'lut' / (name.split('.')[0] if name.split('.')[0] in work.TARGETS else 'three')}", f"work={folder}", f"--modules={packages}")
    if done.returncode:
        raise RuntimeError(done.stderr[-1500:])
    return json.loads(done.stdout), json.loads((packages / needs / "package.json").read_text())["version"]


def save_pictures(row, found, folder, name):
    for file, data in found["pictures"].items():
        path = folder / f"{name}_{file.split('.')[0]}.png"
        path.write_bytes(base64.b64decode(data.split(",")[1]))
        row.pictures.append(path)


def compare_mesh(row, found, folder, file):
    wanted = work.glb(folder / file)
    off = max(abs(numpy.array(found["lower"]) - wanted["POSITION"].min(axis=0)).max(), abs(numpy.array(found["upper"]) - wanted["POSITION"].max(axis=0)).max())
    row.check(f"{file}: bounds {off:.1g} m off the file's", off < 1e-7)
    if "vertices" in found:
        row.check(f"{file}: {found['vertices']:.0f} vertices, {found['indices']} indices, as in the file",
                  (found["vertices"], found["indices"]) == (len(wanted["POSITION"]), len(wanted["indices"])))
    if "tangents" in found:
        off = abs(numpy.array(found["tangents"]).reshape(-1, 4) - wanted["TANGENT"][:10]).max()
        row.check(f"{file}: tangents {off:.1g} off", off < 1e-6)


def compare_tables(row, found, folder):
    """S of the engine's shader against `cuticle eval`, by what the manifest says of the tables."""
    measured, wanted = numpy.array(found["measured"]), work.exact(folder)
    row.check(f"{len(wanted)} directions: the set's probes read right", not measured[:, 3].any())
    stated = json.loads((folder / "lut/manifest.json").read_text())["scattering"]
    for c, name in enumerate("rgb"):
        error = abs(measured[:, c] - wanted[:, c])
        largest = stated[f"S.{name}"]["maximum"]
        row.check(f"S.{name} against cuticle eval: largest {error.max():.2g}, rms {numpy.sqrt((error**2).mean()):.2g} (stated {largest:.2g})", error.max() < 1.2 * largest)


def engine(folder, full, name, program, package, reads_tables=True):
    found, version = page(f"{name}.html", folder, full, package)
    row = Row(program, version, "strands.glb, cards.glb" + (", three tables (KTX2)" if reads_tables else ""))
    if reads_tables:
        compare_tables(row, found, folder)
        if "verified" in found:
            row.check(f"verifyHairLut gives {found['verified']:.0f}", found["verified"] == 0)
    else:
        row.notes.append("tables: not run; a material that reads them needs the compiler matc, which npm has not")
    for file in ("strands.glb", "cards.glb"):
        compare_mesh(row, found[file], folder, file)
    save_pictures(row, found, folder, name)
    return row


def three(folder, full):
    return engine(folder, full, "three", "three.js (WebGL 2)", "three")


def babylon(folder, full):
    return engine(folder, full, "babylon", "Babylon.js (WebGL 2)", "@babylonjs/core")


def playcanvas(folder, full):
    return engine(folder, full, "playcanvas", "PlayCanvas (WebGL 2)", "playcanvas")


def filament(folder, full):
    return engine(folder, full, "filament", "Filament (WebGL 2)", "filament", False)


def viewer(folder, full):
    packages = modules(full)
    model = ["--set", "eta=1.55,sigma_a=0.1/0.2/0.4,beta_deg=11,alpha_deg=-2.5"]
    work.must("viewer", folder / "groom.npz", *model, "--strands", 6000, "--three", packages / "three", "--out", folder / "viewer")
    work.must("bake", *model, "--layout", "nalu_theta", "--out", folder / "viewer_tables")
    read = "({ words: document.querySelector('#panel p').textContent, tables: [0, 1, 2].map((k) => Array.from(cuticleViewer.tables.read(k))) })"
    picture = folder / "viewer.png"
    done = work.node(HERE.parent / "browser/run_page.mjs", folder / "viewer", "index.html?frames=6", "--file", "--ready=document.body.dataset.still", f"--result={read}",
                     f"--screenshot={picture}")
    if done.returncode:
        raise RuntimeError(done.stderr[-1500:])
    row = Row("cuticle viewer in Chromium, from disk", chromium(), "viewer/index.html", pictures=[picture])
    found, baked = json.loads(done.stdout), lut_files.Tables(folder / "viewer_tables").values
    row.check(f"shows {found['words']}", found["words"].startswith(f"6000 of {len(work.groom(folder)['offsets']) - 1} strands"))
    for name, values in zip(("M", "N_TT_R", "N_TRT"), found["tables"]):
        wanted = baked[name]
        error = abs(numpy.reshape(values, (128, 128, 4))[..., :wanted.shape[2]] - wanted) / (wanted + 1e-3 * wanted.max())
        row.check(f"{name} baked by the page against cuticle bake: largest difference {error.max():.2g} of the value", error.max() < 4e-3)
    return row


def chromium():
    return subprocess.run([os.environ.get("CUTICLE_CHROMIUM", "/usr/bin/chromium"), "--version"], capture_output=True, text=True).stdout.strip()


def validator(folder, full):
    packages = modules(full)
    if not (packages / "gltf-validator").exists():
        raise NotRun("the npm package gltf-validator is installed by --full")
    row = Row("Khronos glTF validator", json.loads((packages / "gltf-validator/package.json").read_text())["version"], "strands.glb, cards.glb")
    for file in ("strands.glb", "cards.glb"):
        script = ("const v = require(process.argv[1]); v.validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[2])))"
                  ".then((r) => console.log(JSON.stringify(r.issues)))")
        done = work.node("-e", script, packages / "gltf-validator/index.js", folder / file)
        issues = json.loads(done.stdout)
        said = ", ".join(sorted({each["code"].lower() for each in issues["messages"]})) or "nothing"
        row.check(f"{file}: {issues['numErrors']} errors, {issues['numWarnings']} warnings; says {said}", issues["numErrors"] == 0)
    return row


def usd(folder, full):
    try:
        from pxr import Usd, UsdGeom, UsdValidation
    except ImportError as error:
        raise NotRun(f"usd-core: {error}") from error
    row = Row("usd-core", ".".join(map(str, Usd.GetVersion())), "groom.usda")
    stage = Usd.Stage.Open(str(folder / "groom.usda"))
    curves = UsdGeom.BasisCurves(next(prim for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves)))
    groom, points = work.groom(folder), numpy.array(curves.GetPointsAttr().Get())
    counts = numpy.array(curves.GetCurveVertexCountsAttr().Get())
    row.check(f"{len(counts)} curves, {len(points)} points, as in the groom", (counts == numpy.diff(groom["offsets"].astype(int))).all())
    row.check(f"positions {abs(points - groom['positions']).max():.1g} m off", (points == groom["positions"]).all())
    widths = numpy.array(curves.GetWidthsAttr().Get())
    row.check(f"widths {abs(widths / 2 - groom['radii']).max():.1g} m off the radii", numpy.allclose(widths, 2 * groom["radii"], rtol=1e-6))
    extent = numpy.array(curves.GetExtentAttr().Get())
    row.check("extent holds every curve with its width", (extent[0] <= points.min(axis=0)).all() and (extent[1] >= points.max(axis=0)).all())
    errors = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators()).Validate(stage)
    row.check(f"UsdValidation: {len(errors)} errors", not errors)
    return row


def materialx(folder, full):
    try:
        import MaterialX as mx
        import materialx_shader
    except ImportError as error:
        raise NotRun(f"the Python package MaterialX (opt-in): {error}") from error
    row = Row("MaterialX", mx.getVersionString(), "hair.mtlx (cuticle models --export chiang)")
    document = materialx_shader.document_of(folder / "hair.mtlx")
    valid, message = document.validate()
    row.check(f"validates{'' if valid else ': ' + message[:200]}", valid)
    absorption = next(node for node in document.getNodes() if node.getCategory() == "chiang_hair_bsdf").getInput("absorption_coefficient").getValueString()
    row.check(f"absorption {absorption} as it was given", absorption == "0.1257, 0.2, 0.3")
    source = materialx_shader.glsl_source(document)
    row.check(f"GLSL is generated: {len(source)} characters", "chiang_hair" in source)
    for lobe, off in materialx_shader.compare(document, folder).items():
        row.check(f"GLSL run in a browser, {lobe}: {off:.4f} of the peak off", off < 0.012)
    row.notes.append("compared as pi times the response, with the scales' tilt taken at theta_i, and with MaterialX's factor pi / 2 of the longest paths in place of 1 / (2 pi)")
    return row


def blender(folder, full):
    python = os.environ.get("CUTICLE_BPY_PYTHON")
    if not python:
        raise NotRun("CUTICLE_BPY_PYTHON names no Python that has bpy (pip install bpy==5.0.1 in an environment of its own)")
    done = subprocess.run([python, HERE / "blender_open.py", folder], capture_output=True, text=True, timeout=900)
    if not (folder / "blender.json").exists():
        raise RuntimeError(done.stderr[-1500:])
    found, groom = json.loads((folder / "blender.json").read_text()), work.groom(folder)
    row = Row("Blender (bpy), Cycles", found["version"], "groom.usda, groom.abc, strands.glb, cards.glb, cards.obj",
              pictures=[folder / "blender_chiang.png", folder / "blender_huang.png"])
    curves = numpy.load(folder / "blender_curves.npz")
    turned = groom["positions"] * [1, 1, -1]  # Blender's z is up: (x, y, z) of the file becomes (x, -z, y)
    off = abs(curves["positions"][:, [0, 2, 1]] - turned).max() if len(curves["positions"]) == len(turned) else numpy.inf
    row.check(f"groom.usda: {found['usda']['curves']} curves, {found['usda']['points']} points, positions {off:.1g} m off", off < 1e-7)
    row.check("groom.usda: roots and counts of every curve", (curves["offsets"] == groom["offsets"]).all())
    row.check(f"groom.usda: radii {abs(curves['radii'] - groom['radii']).max():.1g} m off", numpy.allclose(curves["radii"], groom["radii"], rtol=1e-6))
    row.check("groom.usda: attributes " + ", ".join(name for name in found["usda"]["attributes"] if name.startswith("groom_")),
              "groom_id" in found["usda"]["attributes"])
    read = numpy.load(folder / "blender_abc.npz")
    off = abs(read["positions"][:, [0, 2, 1]] - turned).max() if len(read["positions"]) == len(turned) else numpy.inf
    row.check(f"groom.abc at the scale .01: {found['abc']['curves']} curves, positions {off:.1g} m off, roots and counts equal",
              off < 1e-7 and (read["offsets"] == groom["offsets"]).all())
    row.check(f"groom.abc: radii {abs(read['radii'] * 0.01 - groom['radii']).max():.1g} of the object's scale off", numpy.allclose(read["radii"] * 0.01, groom["radii"], rtol=1e-5))
    for file in ("strands.glb", "cards.glb", "cards.obj"):
        mesh, wanted = found[file], work.glb(folder / file.replace("obj", "glb"))["POSITION"]
        off = abs(numpy.array(mesh["lower"])[[0, 2]] - [wanted[:, 0].min(), wanted[:, 1].min()]).max()
        row.check(f"{file}: {mesh['vertices']} vertices, {mesh['edges']} edges, {mesh['faces']} faces, bounds {off:.1g} m off",
                  mesh["vertices"] == len(wanted) and off < 1e-6)
    return row


def blender_addon(folder, full):
    """clients/blender in Blender: a groom in, out, simulated, with a collider; tables baked."""
    python = os.environ.get("CUTICLE_BPY_PYTHON")
    if not python:
        raise NotRun("CUTICLE_BPY_PYTHON names no Python that has bpy (see blender)")
    made = folder / "addon"
    made.mkdir()
    done = subprocess.run([python, HERE / "blender_addon.py", folder / "groom.npz", made, made / "found.json"], capture_output=True, text=True, timeout=900,
                          env={**os.environ, "PYTHONPATH": os.environ.get("CUTICLE_MODULE", str(work.ROOT / "build/release/python"))})
    if not (made / "found.json").exists():
        raise RuntimeError(done.stdout[-500:] + done.stderr[-1000:])
    found = json.loads((made / "found.json").read_text())
    row = Row("Blender (bpy): the add-on", found["version"], "clients/blender/cuticle_hair", pictures=[made / "blender_addon.png"])
    row.check(f"in and out: positions {found['places_off']:.1g} m off, radii {found['radii_off']:.1g} m", found["places_off"] < 1e-6 and found["radii_off"] < 1e-9)
    row.check(f"20 frames of a head turn: {found['from_module']:.1g} m from the module's own motion, roots {found['root_off']:.1g} m off, links {100 * found['stretched']:.1g} % longer",
              found["from_module"] < 1e-6 and found["root_off"] < 1e-6 and found["stretched"] < 1e-3 and found["moved"] > 0.01)
    row.check(f"a ball of 3 cm in the hair: {found['inside_before']} points inside before, {found['inside']} afterwards", found["inside_before"] > 50 > 10 * found["inside"])
    row.check("forgotten: as before", found["forgotten"] == 0)
    row.check("tables baked: " + ", ".join(name for name in found["baked"] if name.endswith(".exr")), "manifest.json" in found["baked"])
    return row


def blender_skin(folder, full):
    """Roots of fur on a character that linear blending moves, against the skin that Blender draws."""
    python, data = os.environ.get("CUTICLE_BPY_PYTHON"), os.environ.get("CUTICLE_TEST_DATA")
    if not python or not data:
        raise NotRun("needs CUTICLE_BPY_PYTHON (see blender) and CUTICLE_TEST_DATA with motion/gltf/Fox.glb")
    work.must("simulate", work.ROOT / "scenes/fox_fur.json", "--frames", "0:12", "--out", folder / "fox")
    roots = {}
    for frame in (0, 12):
        work.must("convert", folder / f"fox/state_{frame:04}.vtp", folder / f"fox_{frame}.npz", "--metres-per-unit", 1)
        with numpy.load(folder / f"fox_{frame}.npz") as file:
            roots[repr(frame / 30)] = file["positions"][file["offsets"][:-1].astype(int)] / 0.01  # the file is in centimetres
    numpy.savez(folder / "fox_roots.npz", **roots)
    done = subprocess.run([python, HERE / "blender_skin.py", pathlib.Path(data) / "motion/gltf/Fox.glb", "Run", folder / "fox_roots.npz", folder / "fox.json"],
                          capture_output=True, text=True, timeout=300)
    if not (folder / "fox.json").exists():
        raise RuntimeError(done.stderr[-1500:])
    row = Row("Blender (bpy): a moving skin", "", "Fox.glb, its clip Run; scenes/fox_fur.json")
    for each in json.loads((folder / "fox.json").read_text()):
        largest = each["largest"] * 0.01
        row.check(f"at {each['time']:.1f} s: {each['roots']} roots at most {largest:.1g} m off the skin that Blender draws ({each['size'] * 0.01:.2f} m long)", largest < 2e-5)
    return row


def head_motion(folder, clip, rate, frame, amplitude, metres_per_unit):
    """Roots on a head that follows the clip's joint Head, at frame 0 and at this one."""
    scene = {"schema_version": 1, "strand_count": 60, "strand_vertices": 4, "frames_per_second": rate,
             "motion": {"bvh": str(clip), "joint": "Head", "amplitude": amplitude, "metres_per_unit": metres_per_unit}}
    (folder / "bvh.json").write_text(json.dumps(scene))
    work.must("simulate", folder / "bvh.json", "--frames", f"0:{frame}", "--out", folder / "bvh")
    found = []
    for each in (0, frame):
        work.must("convert", folder / f"bvh/state_{each:04}.vtp", folder / "bvh.npz", "--metres-per-unit", 1)
        with numpy.load(folder / "bvh.npz") as file:
            found.append(file["positions"][file["offsets"][:-1].astype(int)].astype(float))
    return found


def blender_bvh(folder, full):
    """Heads that follow two BVH clips, against the bones that Blender imports."""
    python, data = os.environ.get("CUTICLE_BPY_PYTHON"), os.environ.get("CUTICLE_TEST_DATA")
    if not python or not data:
        raise NotRun("needs CUTICLE_BPY_PYTHON (see blender) and CUTICLE_TEST_DATA with motion/cmu and motion/makehuman")
    row = Row("Blender (bpy): a head by BVH", "", "cmu/01_01.bvh, makehuman/walk1.bvh")
    for name, rate, frame, of_clip in (("cmu/01_01.bvh", 30, 30, 120), ("makehuman/walk1.bvh", 24, 12, 12)):
        clip = pathlib.Path(data) / "motion" / name
        (folder / "bvh_joint.json").unlink(missing_ok=True)
        done = subprocess.run([python, HERE / "blender_bvh.py", clip, "Head", str(of_clip), folder / "bvh_joint.json"], capture_output=True, text=True, timeout=300)
        if not (folder / "bvh_joint.json").exists():
            raise RuntimeError(done.stderr[-1500:])
        joint = json.loads((folder / "bvh_joint.json").read_text())
        first, now = (roots - roots.mean(0) for roots in head_motion(folder, clip, rate, frame, 1, 0))
        left, _, right = numpy.linalg.svd(first.T @ now)  # the rotation of least squares
        turn_off = abs((left @ right).T - joint["turn"]).max()
        still, moved = head_motion(folder, clip, rate, frame, 0, 0.01)
        travel_off = abs((moved - still).mean(0) / 0.01 - joint["travel"]).max()
        row.check(f"{name}, frame {of_clip}: the turn is {turn_off:.1g} off, the travel {travel_off:.1g} of the file's units", turn_off < 1e-4 and travel_off < 1e-4)
    return row


def godot(folder, full):
    program = shutil.which("godot3-server")
    if not program:
        raise NotRun("godot3-server (Debian's package of that name)")
    project = folder / "godot"
    project.mkdir()
    work.must("bake", *work.MATERIAL, "--target", "godot", "--out", folder / "godot_lut")
    (folder / "godot_lut/godot").rename(project / "hair")
    (project / "project.godot").write_text('config_version=4\n[application]\nconfig/name="tables"\n')
    shutil.copy(HERE / "godot_read.gd", project)
    for arguments in (["-e", "--quit"], ["-s", "godot_read.gd"]):
        done = subprocess.run([program, "--path", project, *arguments], capture_output=True, text=True, timeout=120)
    row = Row("Godot 3 (headless)", done.stdout.split(" - ")[0].replace("Godot Engine ", ""), "the three tables (EXR) with their .import files")
    channels = {14: 3, 15: 4}  # Image.FORMAT_RGBH, FORMAT_RGBAH
    for name, wanted in lut_files.Tables(folder / "godot_lut").values.items():
        path = next(project.glob(f"{name}_*.texels"))
        kind = int(path.stem.split("_")[-1])
        found = numpy.frombuffer(path.read_bytes(), "<f2").reshape(*wanted.shape[:2], channels[kind])[..., :wanted.shape[2]]
        whole = abs(wanted) >= 2.0**-14  # Godot 3 does not keep smaller ones, which are subnormal
        row.check(f"{name}: {wanted.shape[1]} x {wanted.shape[0]} halves, of {whole.sum()} normal ones {(found != wanted)[whole].sum()} differ; "
                  f"of {(~whole).sum()} subnormal ones by {abs(found - wanted)[~whole].max(initial=0):.1g}",
                  (found == wanted)[whole].all() and (abs(found - wanted) < 2.0**-14).all())
        text = (project / f"hair/{name}.exr.import").read_text()
        row.check(f"{name}: imported uncompressed, without mip maps, clamped, filtered",
                  all(words in text for words in ("compress/mode=3", "flags/repeat=0", "flags/filter=true", "flags/mipmaps=false")))
    row.notes.append("Godot 4, which the shaders are for: not run; Debian 12 has none")
    return row


def paraview(folder, full):
    program = shutil.which("pvpython")
    if not program:
        raise NotRun("pvpython; Debian 12's python3-paraview takes libvtk9-dev away, which builds Cuticle: install it elsewhere, or put that back afterwards")
    work.must("simulate", work.ROOT / "scenes/head_turn.json", "--frames", "0:2", "--out", folder / "run")
    work.must("view", "strands", folder / "groom.npz", "--export", folder / "view")
    for _ in range(3):  # xvfb-run -a of two programs at once may choose one display, which the second is not let into
        done = subprocess.run(["xvfb-run", "-a", program, "--force-offscreen-rendering", HERE / "paraview_open.py", next((folder / "view").glob("*.py")), folder,
                               folder / "run/states.pvd"], capture_output=True, text=True, timeout=300)
        if (folder / "paraview.json").exists():
            break
    if not (folder / "paraview.json").exists():
        raise RuntimeError(done.stdout[-700:] + done.stderr[-700:])
    found, arrays = json.loads((folder / "paraview.json").read_text()), numpy.load(folder / "paraview.npz")
    row = Row("ParaView", ".".join(found["version"].strip("()").split(", ")), "states.pvd of a run, the state and strands of cuticle view --export",
              pictures=[folder / "paraview.png"])
    row.check(f"times {', '.join(f'{time:.4g}' for time in found['frames'])} s", numpy.allclose(found["frames"], [0, 1 / 30, 2 / 30]))
    for k in range(3):
        work.must("convert", folder / f"run/state_{k:04}.vtp", folder / f"state_{k}.npz", "--metres-per-unit", 1)
        with numpy.load(folder / f"state_{k}.npz") as file:
            wanted, strands = file["positions"], len(file["offsets"]) - 1
        off = abs(arrays[f"points_{k}"] - wanted).max() if arrays[f"points_{k}"].shape == wanted.shape else numpy.inf
        row.check(f"frame {k}: {arrays[f'lines_{k}']} strands, {len(wanted)} points, {off:.1g} m off", off == 0 and arrays[f"lines_{k}"] == strands)
    row.check(f"state: {found['points']} points, arrays {', '.join(found['arrays'])}", found["points"] == len(work.groom(folder)["positions"]))
    return row


def alembic(folder, full):
    """groom.abc by the Alembic library, without our reader; then our checker of Unreal's schema and our reader."""
    try:
        from alembic3d import Abc, AbcGeom
    except ImportError as error:
        raise NotRun(f"the Python package alembic3d: {error}") from error
    groom, archive = work.groom(folder), Abc.IArchive(str(folder / "groom.abc"))
    row = Row("Alembic", Abc.GetArchiveInfo(archive)["libraryVersionString"].split(" (")[0], "groom.abc")
    schema = AbcGeom.ICurves(archive.getTop().getChild(0), "strands").getSchema()
    sample, parameters = schema.getValue(), schema.getArbGeomParams()
    off = abs(numpy.array(sample.getPositions()) * 0.01 - groom["positions"]).max()
    counts = numpy.array(sample.getCurvesNumVertices())
    row.check(f"{len(counts)} linear curves, positions {off:.1g} m off at .01 m a unit", off < 1e-7 and (counts == numpy.diff(groom["offsets"].astype(int))).all())
    widths = Abc.IArrayProperty(parameters, "groom_width").getValue()
    row.check(f"groom_width: {abs(numpy.array(widths) * 0.005 - groom['radii']).max():.1g} m off the radii", numpy.allclose(numpy.array(widths) * 0.005, groom["radii"], rtol=1e-5))
    headers = [parameters.getPropertyHeader(k) for k in range(parameters.getNumProperties())]
    row.check("parameters (scope): " + ", ".join(f"{each.getName()} ({each.getMetaData().get('geoScope')})" for each in headers), "groom_id" in [each.getName() for each in headers])
    checked = work.run("check", "groom", folder / "groom.abc", "--for", "unreal")
    row.check("cuticle check groom --for unreal: " + "; ".join(line.split(maxsplit=1)[1] for line in checked.stdout.splitlines() if line.startswith("unreal")), checked.returncode == 0)
    work.must("convert", folder / "groom.abc", folder / "from_abc.npz")
    with numpy.load(folder / "from_abc.npz") as back:
        off = abs(back["positions"] - groom["positions"]).max()
    row.check(f"read back: {off:.1g} m off", off < 1e-7)
    row.notes.append("Unreal itself: not run")
    return row


# Quick ones are those of continuous integration.
ROWS = {"viewer": viewer, "three": three, "usd": usd, "validator": validator, "babylon": babylon, "playcanvas": playcanvas, "filament": filament,
        "materialx": materialx, "blender": blender, "blender_addon": blender_addon, "blender_skin": blender_skin, "blender_bvh": blender_bvh, "godot": godot, "paraview": paraview, "alembic": alembic}
QUICK = ("three", "usd")
