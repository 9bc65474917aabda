"""Findings in plain words, made from the numbers of the studies: each with the figure that shows it."""
import dataclasses
import math

from . import growth as growths, ladder as ladders, results, states


@dataclasses.dataclass
class Finding:
    text: str
    anchor: str  # id of a figure on the page
    link: str = "figure"
    is_doubt: bool = False  # says what is not known; such come last


def group_id(study, group):
    return "".join(character if character.isalnum() else "-" for character in f"{study.name}-{group.raw['name']}")


def time(seconds):
    factor, unit = (1, "s") if seconds >= 1 else results.unit_of([seconds])
    return f"{results.shown(seconds * factor, 2)} {unit}"


def percent(value):
    if 0 < value < 1e-4:
        return "less than .01 %"
    return f"{results.shown(100 * value, 2)} %"


def named(group, name):
    return next(point for point in group.points if point.name == name)


def words(point):
    return point.method.replace("_", " ")


def of_hair(group):
    """A ladder's scene in words."""
    return {"blond": "long blond hair", "curls": "black curls", "fur": "fur"}.get(group.raw["name"], group.raw["name"])


def ladder(study):
    """Which rung adds most on each scene, what the whole ladder saves, and which rungs are not told from noise."""
    most, untold, rungs = [], [], 0
    for group in study.groups:
        told = [rung for rung in ladders.rungs(group) if any(ladders.is_told(rung.error(metric)) for metric in ("added", "light") if metric in rung.errors)]
        rungs += len(ladders.rungs(group))
        untold += [f"{words(rung)} ({group.raw['name']})" for rung in ladders.rungs(group) if rung not in told]
        if told:
            worst = max(told, key=lambda rung: rung.error("added")["value"])
            most.append(f"{words(worst)} for {of_hair(group)} (it adds a relative MSE of {results.shown(worst.error('added')['value'], 2)})")
    if most:
        group = study.groups[0]
        first, last = (rung.seconds and rung.seconds["value"] for rung in (ladders.truth(group) or group.points[0], group.points[-1]))
        saved = f" A real-time frame of {of_hair(group)} takes {time(last)}; the traced one took {time(first)}." if first and last else ""
        yield Finding(f"From path tracing to the real-time picture, the step that changes most is {', '.join(most)}.{saved}",
                      group_id(study, group), "the ladder")
    if untold:
        yield Finding(f"{rungs - len(untold)} of {rungs} steps of the ladder change the picture for certain; not told from zero: {', '.join(untold)}.",
                      group_id(study, study.groups[0]), "the ladder", is_doubt=True)


def models(study):
    """Which model comes nearest to the truth's picture, and what its tables change."""
    group = study.groups[0]
    told = sorted((point for point in group.points if point.error("light")["value"] > 0), key=lambda point: point.error("light")["value"])
    if len(told) > 1:
        best, worst = told[0], told[-1]
        yield Finding(f"Of all models with the same fibre, {best.method} ({best.knobs['evaluate']}) comes nearest to the picture of the truth: its light is off by a relative MSE of "
                      f"{results.shown(best.error('light')['value'], 2)}; {worst.method} ({worst.knobs['evaluate']}) is farthest, {results.shown(worst.error('light')['value'], 2)}.", group_id(study, group))


def tables(study):
    """Where tables pay beside the model itself."""
    for group in study.groups:
        arrays = next((p for p in group.drawable() if p.method.startswith("the model, arrays")), None)
        sets = [p for p in group.drawable() if not p.method.startswith("the model")]
        if not arrays or not sets:
            continue
        faster = [p for p in sets if p.seconds["high"] is not None and arrays.seconds["low"] is not None and p.seconds["high"] < arrays.seconds["low"]]
        best = min(faster or sets, key=lambda p: p.error(group.metric)["value"])
        found = f"the most exact set of tables that is faster for certain, {setting(best.name)}, is off by {percent(best.error(group.metric)['value'])}" if faster else \
            f"no set of tables is faster for certain, and the most exact, {setting(best.name)}, is off by {percent(best.error(group.metric)['value'])}"
        yield Finding(f"On a CPU, evaluating {group.raw['name']} itself in arrays takes {time(arrays.seconds['value'])} for one direction and is exact to "
                      f"{percent(arrays.error(group.metric)['value'])}; {found}.", group_id(study, group))


def precision(study):
    """What single precision costs in error and saves in time, over all models."""
    best = None
    for group in study.groups:
        by_tier = {}
        for point in group.points:
            by_tier.setdefault(point.knobs.get("tier"), {})[point.method] = point
        for pair in by_tier.values():
            if set(pair) == {"float", "double"} and pair["float"].seconds and pair["double"].seconds:
                worst = pair["float"].errors[group.metric]["p99"] - pair["double"].errors[group.metric]["p99"]
                gain = pair["double"].seconds["value"] / pair["float"].seconds["value"]
                best = max(best or (0,), (worst, gain, group, study), key=lambda item: item[0])
    if best and best[0]:
        yield Finding(f"Single precision is enough for every model: it changes S by at most {results.shown(best[0], 2)} of itself for 99 of 100 directions; in that model, "
                      f"{best[2].raw['name']}, it is {results.shown(best[1], 2)} times as fast as double.", group_id(best[3], best[2]))


def cheapest(group, wanted):
    """The choice for an error of at most so much; None: none meets it, or the group is not measured so finely."""
    return next((step["choice"] for step in group.conclusions["cheapest_for"] if math.isclose(step["error_at_most"], wanted, rel_tol=1e-4)), None)


def setting(text):
    """"opacity_map slices=8" in words: "opacity map with 8 slices"; a size or resolution in texels each way."""
    parts = text.split(" ")
    knobs = [part.split("=", 1) for part in parts if "=" in part]
    said = [f"{value} x {value} texels" if name in ("size", "resolution") else f"{value} {name}".replace("_", " ") if value.replace(".", "").isdigit() else f"{name} {value}".replace("_", " ")
            for name, value in knobs]
    said = [text.removesuffix("s") if text.startswith("1 ") else text for text in said]
    return " ".join(part for part in parts if "=" not in part).replace("_", " ") + (" with " + ", ".join(said) if said else "")


def place(study, group):
    """" for a swing": of which of a study's groups something is said; nothing where there is one alone."""
    return f" for {group.raw['name']}" if len(study.groups) > 1 else ""


def choices(study, wanted, head, unit):
    """The cheapest setting for an error in each group of a study, in one sentence."""
    found = [(group, cheapest(group, wanted)) for group in study.groups if group.drawable()]
    parts = [f"{setting(choice['point'])}{place(study, group)} ({time(choice['seconds'])} {unit})" for group, choice in found if choice]
    none = [group.raw["name"] for group, choice in found if not choice]
    if parts:
        group = next(group for group, choice in found if choice)
        yield Finding(f"{head} {', '.join(parts)}{'; none for ' + ', '.join(none) if none else ''}.", group_id(study, group))


def volume(study):
    points = {point.method: point for point in study.groups[0].points}
    if "linear_blend" in points:
        yield Finding(f"Linear blend loses up to {percent(points['linear_blend'].errors['volume']['max'])} of a twisted limb's volume, dual quaternions "
                      f"{percent(points['dual_quaternion'].errors['volume']['max'])}.", group_id(study, study.groups[0]))


def state_words(point):
    state = point.knobs["state"]
    return f"a {state} {point.method}" if state in ("still", "moving") else f"{point.method} {state}"


def plan(study):
    """What a still scene and hair out of view cost, and which feature is dearest."""
    groups = {group.raw["name"]: group for group in study.groups}
    if "frames" in groups:
        parts = [f"{state_words(pair[1])} costs {percent(pair[1].seconds['value'] / pair[0].seconds['value'])} of {state_words(pair[0])}" for pair in states.pairs(groups["frames"])]
        yield Finding(f"What does not change and what is not seen is left out: {', '.join(parts)}.", group_id(study, groups["frames"]))
    if "features" in groups and (told := [pair for pair in states.pairs(groups["features"]) if states.is_told(pair) and states.saved(pair) > 0]):
        yield Finding(f"Of {len(states.pairs(groups['features']))} features, none runs a pass where it is off; leaving out {', '.join(states.name(pair) for pair in told[:3])} saves most of a frame: "
                      f"{', '.join(states.label(pair) for pair in told[:3])}.", group_id(study, groups["features"]))


OF_GROWTH = {"frame": "passes of a frame", "solvers": "solvers", "shadows": "shadow methods", "files": "readers and writers of strand files"}
SUMS = {"all passes", "submissions", "clock", "processor"}  # of a frame's passes


def growth(study):
    """What takes longest at the largest size of each group, and what grows faster than its size."""
    for group in filter(growths.is_of, study.groups):
        size, knob = growths.sizes(group)[-1], growths.knob_of(group)
        at_most = {method: seconds[size] for method, seconds in growths.curves(group).items() if size in seconds and method not in SUMS}
        longest = max(at_most, key=at_most.get)
        steep = {method: fit for method, fit in growths.steep(group).items() if method not in SUMS}
        faster = f"; {', '.join(f'{method} (power {fit[0]:.2f})' for method, fit in steep.items())} {'grow' if len(steep) > 1 else 'grows'} faster than the number of {knob}" if steep else \
            f"; nothing grows faster than the number of {knob}"
        yield Finding(f"Of the {OF_GROWTH.get(group.raw['name'], group.raw['name'])} with {size:,.0f} {knob}, {longest} takes longest ({time(at_most[longest])}){faster}.", group_id(study, group), "table")


MAKERS = {"picture": ladder, "plan": plan, "models": models, "luts": tables, "lobes": precision, "skinning": volume, "growth": growth,
          "shadows": lambda study: choices(study, 0.03, "Shadows with a mean error of transmittance of at most 3 % cost least by", "for all vertices"),
          "motion": lambda study: choices(study, 0.03, "Motion that stays within 3 % of a strand's length for half a second costs least by", "a strand and frame"),
          "render": lambda study: choices(study, 0.03, "Drawing with a mean error of coverage of at most 3 % costs least by", "a frame")}
ORDER = ("picture", "luts", "shadows", "render", "motion", "plan", "models", "lobes", "skinning", "growth")


def find(studies, most=5):
    """The first finding of each study, then the second, and so on: `most` of them."""
    by_name = {study.name: study for study in studies}
    lists = [list(MAKERS[name](by_name[name])) for name in ORDER if name in by_name and name in MAKERS]
    rounds = [found for turn in range(max(map(len, lists), default=0)) for found in (one[turn:turn + 1] for one in lists)]
    chosen = [finding for found in rounds for finding in found][:most]
    return sorted(chosen, key=lambda finding: finding.is_doubt)
