"""Opens what Cuticle writes in the programs that its users have, and writes one page of what was found.

    python tests/clients/run.py [--full] [--only three,usd] [--out clients]

Without --full, three.js and usd-core alone, on a small groom. --full installs the npm packages of this folder; Blender is asked where
CUTICLE_BPY_PYTHON names a Python with bpy. Exit code 1: something was opened wrong."""
import argparse
import html
import pathlib
import shutil
import sys
import tempfile
import traceback

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import rows  # noqa: E402
import work  # noqa: E402

STYLE = """body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 1150px; padding: 0 1em; color: #1d2126 }
h1 { font-size: 24px } table { border-collapse: collapse; width: 100% } td, th { border-top: 1px solid #d5d9de; padding: 10px 8px; vertical-align: top; text-align: left }
td.program { width: 170px } ul { margin: 0; padding-left: 1.1em } li.wrong { color: #b00020; font-weight: 600 } .none { color: #68707a }
.pictures img { width: 150px; height: 150px; object-fit: cover; margin: 0 6px 6px 0; background: #22262b } small { color: #68707a }"""


def cells(row, out):
    compared = "".join(f"<li{'' if holds else ' class=wrong'}>{html.escape(words)}</li>" for words, holds in row.compared)
    pictures = ""
    for path in row.pictures:
        shutil.copy(path, out / path.name)
        pictures += f'<a href="{path.name}"><img src="{path.name}" alt="{html.escape(row.program)}: {path.stem}"></a>'
    compared += "".join(f"<li class=none>{html.escape(words)}</li>" for words in row.notes)
    return (f"<tr><td class=program><b>{html.escape(row.program)}</b><br><small>{html.escape(row.version)}</small></td><td>{html.escape(row.opened)}</td>"
            f"<td><ul>{compared}</ul></td><td class=pictures>{pictures}</td></tr>")


def row_of(name, folder, full, out):
    """The row's cells, and whether it holds; None: it was not run."""
    try:
        row = rows.ROWS[name](folder, full)
        print(f"{name}: {row.version}: {'right' if all(holds for _, holds in row.compared) else 'WRONG'}", flush=True)
        for words, holds in row.compared:
            print(f"  {'' if holds else 'WRONG: '}{words}")
        return cells(row, out), all(holds for _, holds in row.compared)
    except rows.NotRun as why:
        print(f"{name}: not run: {why}")
        return f"<tr class=none><td class=program><b>{name}</b></td><td colspan=3>not run: {html.escape(str(why))}</td></tr>", None
    except Exception as error:
        traceback.print_exc()
        return f"<tr><td class=program><b>{name}</b></td><td colspan=3 class=wrong>failed: {html.escape(str(error)[:600])}</td></tr>", False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("clients"))
    options = parser.parse_args()
    names = options.only.split(",") if options.only else rows.ROWS if options.full else rows.QUICK
    if unknown := [name for name in names if name not in rows.ROWS]:
        parser.error(f"no row {', '.join(unknown)}; there are {', '.join(rows.ROWS)}")
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        work.make(folder, 1 if options.full else 0.1)
        found = [row_of(name, folder, options.full, options.out) for name in names]
    ran, right = sum(holds is not None for _, holds in found), sum(holds is True for _, holds in found)
    words = f"{ran} programs opened what {work.version()} wrote on this machine, {right} of them right; {len(found) - ran} were not run."
    (options.out / "index.html").write_text(
        f"<!doctype html><html lang=en><meta charset=utf-8><title>What Cuticle writes, opened elsewhere</title><style>{STYLE}</style>"
        f"<h1>What Cuticle writes, opened elsewhere</h1><p>{words} Browsers draw by software here.</p><table><tr><th>program<th>opened<th>compared<th>picture</tr>"
        + "".join(text for text, _ in found) + "</table></html>\n")
    print(f"{options.out / 'index.html'}: {words}")
    return 0 if right == ran else 1


if __name__ == "__main__":
    sys.exit(main())
