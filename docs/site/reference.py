"""The reference pages, written from what the program says about itself: registries, --help, the scene's schema, Python's docstrings."""
import ast
import json
import math
import os
import pathlib
import subprocess

KINDS = {"models": "fibre scattering models", "methods": "shadow methods", "effects": "simulation effects and solvers", "passes": "passes of a frame"}


def program(root):
    return pathlib.Path(os.environ.get("CUTICLE_PROGRAM", root / "build/release/bin/cuticle"))


def said(root, *arguments):
    done = subprocess.run([program(root), *arguments], capture_output=True, text=True, timeout=60)
    if done.returncode != 0:
        raise RuntimeError(f"cuticle {' '.join(arguments)}: {done.stderr}")
    return done.stdout


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def number(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def value_of(parameter, text):
    """A value as it would be typed; an angle in radians also in degrees."""
    if parameter["unit"] != "rad":
        return number(text)
    try:
        return f"{float(text):.4g} ({math.degrees(float(text)):.4g} degrees)"
    except ValueError:
        return text


def range_of(parameter):
    if "choices" in parameter:
        return ", ".join(f"`{choice}`" for choice in parameter["choices"])
    if "range" in parameter:
        return " .. ".join(value_of(parameter, end) for end in parameter["range"])
    return ""


def parameter_table(parameters):
    if not parameters:
        return "It has no parameters.\n"
    lines = ["| parameter | default | range | unit | what |", "|---|---|---|---|---|"]
    for parameter in parameters:
        unit = "" if parameter["unit"] == "1" else parameter["unit"]
        lines.append(f"| `{parameter['name']}` | {cell(value_of(parameter, parameter['default']))} | {cell(range_of(parameter))} | {unit} | {cell(parameter['summary'])} |")
    return "\n".join(lines) + "\n"


def entry_section(entry):
    text = f"## {entry['name']}\n\n{entry['summary']}.\n\nSource: {entry['source']}.\n\n"
    if entry.get("lobes"):
        text += "Lobes: " + ", ".join(f"`{lobe}`" for lobe in entry["lobes"]) + ".\n\n"
    if entry.get("presets"):
        text += "Presets: " + ", ".join(f"`{preset['name'] if isinstance(preset, dict) else preset}`" for preset in entry["presets"]) + ".\n\n"
    if entry.get("demands"):
        text += "Runs where the scene has: " + ", ".join(f"`{fact}`" for fact in entry["demands"]) + ".\n\n"
    return text + parameter_table(entry.get("parameters", [])) + "\n"


def registry_page(root, kind):
    entries = json.loads(said(root, kind, "--json"))
    text = f"# {kind.capitalize()}\n\nThe {KINDS[kind]} of this build, as `cuticle {kind}` lists them.\n\n"
    return text + "".join(entry_section(entry) for entry in entries)


def subcommands(help_text):
    """Names under `Subcommands:` of a --help text."""
    if "Subcommands:" not in help_text:
        return []
    lines = help_text.split("Subcommands:")[1].splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and not line.startswith("   ")]


def command_sections(root, words):
    text = said(root, *words, "--help")
    yield f"## cuticle {' '.join(words)}\n\n```text\n{text.strip()}\n```\n\n"
    for name in subcommands(text):
        yield from command_sections(root, [*words, name])


def commands_page(root):
    head = "# Every command\n\nWhat `--help` prints. The options of every command are listed first.\n\n"
    general = said(root, "--help")
    text = head + f"## cuticle\n\n```text\n{general.strip()}\n```\n\n"
    return text + "".join(section for name in subcommands(general) for section in command_sections(root, [name]))


def schema_rows(schema, path=""):
    for key, value in schema.get("properties", {}).items():
        place = f"{path}.{key}" if path else key
        span = " .. ".join(number(value[end]) for end in ("minimum", "maximum") if end in value)
        yield f"| `{place}` | {value.get('type', '')} | {span} | {cell(value.get('description', ''))} |"
        if value.get("type") == "object" and len(place.split(".")) < 3:
            yield from schema_rows(value, place)


def scene_page(root):
    schema = json.loads((root / "docs/scene.schema.json").read_text(encoding="utf-8"))
    head = ("# The scene file\n\nJSON, in which `//` comments may stand. [The schema](../docs/scene.schema.json) has every key; blocks of models, methods, effects "
            "and passes hold the parameters of their own pages.\n\n| key | type | range | what |\n|---|---|---|---|\n")
    return head + "\n".join(schema_rows(schema)) + "\n"


def python_page(root):
    tree = ast.parse((root / "python/cuticle/__init__.py").read_text(encoding="utf-8"))
    text = f"# Python\n\n{ast.get_docstring(tree)}\n\n"
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            text += f"## cuticle.{node.name}\n\n```python\ncuticle.{node.name}({ast.unparse(node.args)})\n```\n\n{ast.get_docstring(node)}\n\n"
    return text


def pages(root):
    """Name and text of every page."""
    made = {kind: registry_page(root, kind) for kind in KINDS}
    return made | {"commands": commands_page(root), "scene": scene_page(root), "python": python_page(root)}
