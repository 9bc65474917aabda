"""What each shadow method reaches within the same bytes and the same time: a table from studies of `cuticle shadows --out`.

  python bench/shadow_budgets.py STUDY.json [STUDY.json ..] [--methods opacity_map,deep_opacity] [--mib 0.25,1,4,16,64] [--ms 5,10,20,50,100]

Within each budget a method's setting is the one with the least error on one half of the receivers; what is printed is its error on the other half,
half of a 95 % interval, and the setting. "none": no setting of the study keeps the budget.
"""
import argparse
import json


def best(rows, key, limit):
    fit = [row for row in rows if row[key] <= limit]
    return min(fit, key=lambda row: row["choosing_error"], default=None)


def cell(row):
    return "none" if row is None else f"{row['mean_error']:.4f} +- {row['mean_interval']:.4f} ({row['settings'] or 'default'})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("studies", nargs="+")
    parser.add_argument("--methods", default="opacity_map,deep_opacity")
    parser.add_argument("--mib", default="0.25,1,4,16,64")
    parser.add_argument("--ms", default="5,10,20,50,100")
    options = parser.parse_args()
    methods = options.methods.split(",")
    for path in options.studies:
        with open(path) as file:
            study = json.load(file)
        print(f"{study['groom']['name']}: the truth leaves {study['truth']['light_left']:.4f} of the light")
        for key, unit, scale, budgets in (("bytes", "MiB", 2**20, options.mib), ("total_ms", "ms", 1, options.ms)):
            for budget in map(float, budgets.split(",")):
                found = [cell(best([row for row in study["rows"] if row["method"] == method], key, scale * budget)) for method in methods]
                print(f"{budget:g} {unit}: " + "; ".join(f"{method} {text}" for method, text in zip(methods, found)))


if __name__ == "__main__":
    main()
