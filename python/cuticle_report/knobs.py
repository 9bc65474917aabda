"""Error against a setting: of each method the points that set one number alone, a curve for each group."""
LEAST_POINTS = 3  # of a curve


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def error_curves(study):
    """(method, knob): name of the group: (value, error) by value; of what logarithmic axes have a place for."""
    found = {}
    for group in study.groups:
        if not group.metric:
            continue
        for point in group.points:
            value = number(next(iter(point.knobs.values()))) if len(point.knobs) == 1 else None
            error = point.error(group.metric)["value"]
            if value and value > 0 and error and error > 0:
                found.setdefault((point.method, next(iter(point.knobs))), {}).setdefault(group.raw["name"], []).append((value, error))
    return {key: {name: sorted(values) for name, values in curves.items() if len(values) >= LEAST_POINTS} for key, curves in found.items()}


def plots(study):
    """Plots as a study brings them along (study/README.md)."""
    labels = {group.metric: group.raw["metrics"][0]["label"] for group in study.groups if group.metric}
    found = []
    for (method, knob), curves in error_curves(study).items():
        if not curves or len(labels) != 1:
            continue
        label = next(iter(labels.values()))
        found.append({"name": "".join(letter if letter.isalnum() else "-" for letter in f"{method}-{knob}"), "title": f"{method}: {label}, by {knob}", "x_label": knob, "y_label": label, "polar": False, "logarithmic": True,
                      "curves": [{"name": name, "x": [x for x, _ in values], "y": [y for _, y in values]} for name, values in curves.items()]})
    return found
