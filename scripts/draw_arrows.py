#!/usr/bin/env python3
"""Draws which module includes which, from the includes alone: scripts/draw_arrows.py [--check] writes docs/architecture.svg.

Arrows that follow from others are left out. --check writes nothing and fails where the file is not what would be written.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/structure"))
import repository  # noqa: E402

OUT = ROOT / "docs/architecture.svg"
WIDTH, HEIGHT, ACROSS, DOWN = 108, 30, 132, 78
TESTS = re.compile(r"(_test|_fuzz|_bench)\.cpp$|(^|/)test_|/tests/|^(tests|bench)/")


def arrows(paths):
    """Module -> modules that its files include; without tests and benchmarks."""
    found = {}
    for path in paths:
        if TESTS.search(path) or path.endswith((".py", ".sh")):
            continue
        module = repository.module_of(path)
        if module in repository.ARROWS or module in repository.LEAVES:
            used = {repository.module_of(name) for name in repository.includes(path)}
            found.setdefault(module, set()).update(used - {module})
    return {module: {u for u in used if u in found} for module, used in found.items()}


def cycle(graph):
    """Modules on a cycle, in its order; empty when there is none."""
    done, way = set(), []

    def visit(module):
        if module in way:
            return way[way.index(module):]
        if module in done:
            return []
        way.append(module)
        for used in sorted(graph[module]):
            if met := visit(used):
                return met
        done.add(way.pop())
        return []

    return next((met for module in sorted(graph) if (met := visit(module))), [])


def reached(graph, module):
    return set().union(*({used} | reached(graph, used) for used in graph[module]))


def reduced(graph):
    """Without arrows that follow from others."""
    return {m: {u for u in used if not any(u in reached(graph, other) for other in used - {u})} for m, used in graph.items()}


def layers(graph):
    """Rows of modules and of the passages (from, to, row) of long arrows, lowest first, ordered so that few arrows cross."""
    level = {}
    for module in sorted(graph, key=lambda m: len(reached(graph, m))):
        level[module] = 1 + max((level[u] for u in graph[module]), default=-1)
    rows = [sorted(m for m in graph if level[m] == k) for k in range(max(level.values()) + 1)]
    ways = {}
    for module, used in sorted(graph.items()):
        for other in sorted(used):
            passed = [(module, other, k) for k in range(level[other] + 1, level[module])]
            for passage in passed:
                rows[passage[2]].append(passage)
            ways[module, other] = [other, *passed, module]
    for _ in range(12):
        for k in range(1, len(rows)):
            order_by_neighbours(rows[k], rows[k - 1], ways)
        for k in range(len(rows) - 2, -1, -1):
            order_by_neighbours(rows[k], rows[k + 1], ways)
    return rows, ways


def order_by_neighbours(row, fixed, ways):
    place = {node: (i + 0.5) / len(fixed) for i, node in enumerate(fixed)}
    pairs = [pair for way in ways.values() for pair in zip(way, way[1:])]

    def mean(node):
        met = [place[b if a == node else a] for a, b in pairs if (a == node and b in place) or (b == node and a in place)]
        return (sum(met) / len(met) if met else (row.index(node) + 0.5) / len(row))

    weights = {node: mean(node) for node in row}
    row.sort(key=lambda node: (weights[node], str(node)))


def drawing(graph):
    rows, ways = layers(reduced(graph))
    widest = max(len(row) for row in rows)
    place = {node: (ACROSS * (widest - len(row)) / 2 + ACROSS * (i + 0.5), DOWN * (len(rows) - 0.5 - k))
             for k, row in enumerate(rows) for i, node in enumerate(row)}
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {ACROSS * widest} {DOWN * len(rows)}" '
             'font-family="sans-serif" font-size="14" text-anchor="middle">',
             '<title>Which module includes which; arrows that follow from others are left out</title>',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
             '<path d="M0 0L8 4L0 8z" fill="#555"/></marker></defs>', '<rect width="100%" height="100%" fill="#fff"/>']
    for _, way in sorted(ways.items()):
        points = [place[node] for node in reversed(way)]
        points[0] = (points[0][0], points[0][1] + HEIGHT / 2)
        points[-1] = (points[-1][0], points[-1][1] - HEIGHT / 2)
        curve = f"M{points[0][0]:g} {points[0][1]:g}"
        for (x0, y0), (x1, y1) in zip(points, points[1:]):
            curve += f"C{x0:g} {(y0 + y1) / 2:g} {x1:g} {(y0 + y1) / 2:g} {x1:g} {y1:g}"
        lines.append(f'<path d="{curve}" fill="none" stroke="#555" marker-end="url(#tip)"/>')
    for module in sorted(graph):
        x, y = place[module]
        lines.append(f'<rect x="{x - WIDTH / 2:g}" y="{y - HEIGHT / 2:g}" width="{WIDTH}" height="{HEIGHT}" rx="4" fill="#eef3fb" '
                     f'stroke="#335"/><text x="{x:g}" y="{y + 5:g}">{module}</text>')
    return "\n".join([*lines, "</svg>", ""])


def main():
    graph = arrows(repository.code_files())
    if met := cycle(graph):
        sys.exit("draw_arrows: a cycle: " + " -> ".join([*met, met[0]]))
    text = drawing(graph)
    if "--check" in sys.argv[1:]:
        sys.exit(0 if OUT.exists() and OUT.read_text() == text else f"draw_arrows: run scripts/draw_arrows.py, {OUT.name} is not up to date")
    OUT.write_text(text)


if __name__ == "__main__":
    main()
